#include "io/mcap/rotating_writer.hpp"

#include <string>
#include <utility>

#include "io/mcap/repair.hpp"

namespace godwit::io::mcap {

result<void> rotating_writer::open(rotating_writer_options options) {
  if (auto closed = close(); !closed) {
    return closed;
  }
  options_ = std::move(options);
  failure_.reset();
  return folder_.open(options_.segments);
}

result<schema_id> rotating_writer::add_schema(std::string_view name, std::string_view encoding, byte_view data) {
  return channels_.add_schema(name, encoding, data);
}

result<channel_id> rotating_writer::add_channel(schema_id schema, std::string_view topic,
                                                std::string_view message_encoding, const string_map& metadata) {
  return channels_.add_channel(schema, topic, message_encoding, metadata);
}

result<void> rotating_writer::write(const message_record& message) {
  const auto closed_bytes = [&] { return writer_.closed_bytes_with(message.channel, message.data.size()); };
  if (auto provided = provide_segment(closed_bytes); !provided) {
    ++counts_.messages_lost;
    return provided;
  }
  result<void> written = writer_.write(message);
  if (!written && writer_.is_open()) {
    ++counts_.messages_lost; // refused; what a failed writer had accepted is counted in fail()
  }
  return checked(std::move(written));
}

result<void> rotating_writer::add_metadata(std::string_view name, const string_map& values) {
  const auto closed_bytes = [&] { return writer_.closed_bytes_with(name, values); };
  if (auto provided = provide_segment(closed_bytes); !provided) {
    return provided;
  }
  return checked(writer_.add_metadata(name, values));
}

template <class ClosedBytes>
result<void> rotating_writer::provide_segment(ClosedBytes closed_bytes) {
  if (failure_) {
    return tl::make_unexpected(*failure_);
  }
  if (writer_.is_open() && closed_bytes() > options_.segments.segment_bytes) {
    if (auto closed = close(); !closed) {
      return closed;
    }
  }
  if (!writer_.is_open()) {
    if (auto started = start_segment(); !started) {
      return started;
    }
  }
  if (closed_bytes() > options_.segments.segment_bytes) {
    return tl::make_unexpected(
        error{errc::too_large, current_segment().string(), "one record does not fit into a segment", 0});
  }
  return {};
}

result<void> rotating_writer::start_segment() {
  const result<std::filesystem::path> path = folder_.add(options_.run);
  if (!path) {
    fail(path.error());
    return tl::make_unexpected(path.error());
  }
  has_segment_ = true;
  if (auto opened = checked(writer_.open(*path)); !opened) {
    return opened;
  }
  ++counts_.segments_opened;
  return checked(add_opening_metadata());
}

result<void> rotating_writer::add_opening_metadata() {
  if (!options_.run_info.empty()) {
    if (auto added = writer_.add_metadata("godwit.run", options_.run_info); !added) {
      return added;
    }
  }
  if (counts_.messages_lost == lost_written_down_) {
    return {};
  }
  return writer_.add_metadata("godwit.lost", {{"messages", std::to_string(counts_.messages_lost)}}).map([this] {
    lost_written_down_ = counts_.messages_lost;
  });
}

result<void> rotating_writer::tick(std::uint64_t now_ns) {
  now_ns_ = now_ns;
  if (failure_) {
    return now_ns_ >= retry_at_ns_ ? recover() : tl::make_unexpected(*failure_);
  }
  if (auto in_place = look_at_place(); !in_place) {
    return in_place;
  }
  if (now_ns_ - flushed_at_ns_ < options_.flush_interval_ns) {
    return {};
  }
  flushed_at_ns_ = now_ns_;
  return flush();
}

// What goes into a file that was deleted is lost without an error of the system.
result<void> rotating_writer::look_at_place() {
  if (!writer_.is_open() || now_ns_ - looked_at_ns_ < options_.look_interval_ns) {
    return {};
  }
  looked_at_ns_ = now_ns_;
  if (writer_.is_in_place()) {
    return {};
  }
  const error gone{errc::gone, current_segment().string(), "it was removed or replaced while it was written", 0};
  fail(gone);
  return tl::make_unexpected(gone);
}

result<void> rotating_writer::flush() {
  if (failure_) {
    return tl::make_unexpected(*failure_);
  }
  return writer_.is_open() ? checked(writer_.flush()) : result<void>{};
}

result<void> rotating_writer::close() {
  if (!writer_.is_open()) {
    return {};
  }
  result<void> closed = checked(writer_.close());
  if (closed) {
    has_segment_ = false;
    counts_.messages_flushed += writer_.messages_flushed();
    folder_.note_size(writer_.bytes_written());
  }
  return closed;
}

result<void> rotating_writer::checked(result<void> outcome) {
  if (!outcome && !writer_.is_open()) {
    fail(outcome.error());
  }
  return outcome;
}

void rotating_writer::fail(const error& why) {
  ++counts_.failures;
  failure_ = why;
  retry_at_ns_ = now_ns_ + options_.retry_interval_ns;
  broken_.clear();
  if (!std::exchange(has_segment_, false)) {
    return; // not even a name was given: there is nothing to account for
  }
  writer_.abandon();
  counts_.messages_flushed += writer_.messages_flushed();
  counts_.messages_lost += writer_.messages_lost();
  folder_.note_size(writer_.bytes_written());
  if (writer_.messages_flushed() > 0) {
    broken_ = folder_.segments().back().path;
  } else {
    static_cast<void>(folder_.remove_newest()); // a full disk must not fill the folder with empty segments
  }
}

result<void> rotating_writer::recover() {
  if (!broken_.empty()) {
    const result<completion> completed = complete(broken_);
    if (!completed && completed.error().code == errc::disk_full) {
      failure_ = completed.error();
      retry_at_ns_ = now_ns_ + options_.retry_interval_ns;
      return tl::make_unexpected(*failure_);
    }
    // Whatever else keeps it from being completed is for complete_all() of the next start to report.
    std::error_code code;
    const std::uintmax_t size_bytes = std::filesystem::file_size(broken_, code);
    folder_.note_size(code ? 0 : size_bytes);
    broken_.clear();
  }
  if (auto renewed = folder_.renew(); !renewed) {
    failure_ = renewed.error();
    retry_at_ns_ = now_ns_ + options_.retry_interval_ns;
    return renewed;
  }
  failure_.reset();
  return {};
}

rotating_writer_counts rotating_writer::counts() const {
  rotating_writer_counts now = counts_;
  now.messages_flushed += has_segment_ ? writer_.messages_flushed() : 0;
  now.segments_deleted = folder_.segments_deleted();
  return now;
}

std::filesystem::path rotating_writer::current_segment() const {
  return has_segment_ ? folder_.segments().back().path : std::filesystem::path{};
}

} // namespace godwit::io::mcap
