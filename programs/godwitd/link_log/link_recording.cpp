#include "programs/godwitd/link_log/link_recording.hpp"

#include <system_error>

namespace godwit::daemon {

namespace fs = std::filesystem;
using io::mcap::result;

result<void> link_recording::open(const link_log_options& options, const std::string& link, std::uint64_t run) {
  run_ = run;
  io::mavlink::tlog_writer_options files;
  files.file_bytes = options.segment_bytes;
  files.next_file = [this] { return next_file(); };
  return folder_
      .open({.folder = options.folder,
             .prefix = link,
             .segment_bytes = options.segment_bytes,
             .total_bytes = options.total_bytes,
             .extension = ".tlog"})
      .and_then([&] { return writer_.open(std::move(files)); });
}

// A file into which nothing could be written must not push out one that holds a flight.
result<fs::path> link_recording::next_file() {
  if (has_file_) {
    std::error_code code;
    const auto size_bytes = fs::file_size(folder_.segments().back().path, code);
    if (!code && size_bytes > 0)
      folder_.note_size(size_bytes);
    else if (auto removed = folder_.remove_newest(); !removed)
      return tl::make_unexpected(removed.error());
  }
  auto added = folder_.add(run_);
  has_file_ = added.has_value();
  return added;
}

void link_recording::take(const link_batch& batch) {
  const std::span<const std::byte> bytes(batch.bytes);
  std::size_t at = 0;
  for (const auto& each : batch.chunks) {
    const auto of_chunk = bytes.subspan(at, each.size_bytes);
    at += each.size_bytes;
    const auto write = [&](const io::mavlink::frame_view& frame) { note(writer_.write(each.time_us, frame)); };
    if (each.is_sent) {
      sent_.feed_datagram(of_chunk, write);
    } else {
      auto& from = streams_[each.peer];
      if (each.is_datagram)
        from.feed_next_datagram(of_chunk, write);
      else
        from.feed(of_chunk, write);
      if (streams_.size() > max_streams)
        streams_.erase(streams_.begin()); // peers are numbered as they come
    }
  }
}

void link_recording::flush(std::int64_t now_ns) {
  if (!problem_.empty() && now_ns < retry_at_ns_)
    return;
  const auto before = writer_.counts().frames_written;
  const auto written = writer_.flush();
  if (!written)
    retry_at_ns_ = now_ns + retry_interval_ns;
  else if (writer_.counts().frames_written != before)
    problem_.clear();
  note(written);
}

void link_recording::close() { note(writer_.close()); }

void link_recording::note(const result<void>& written) {
  if (!written)
    problem_ = written.error().message();
}

} // namespace godwit::daemon
