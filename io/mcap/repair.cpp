#include "io/mcap/repair.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "io/mcap/chunks.hpp"
#include "io/mcap/format.hpp"
#include "io/mcap/output_file.hpp"
#include "io/mcap/record_reader.hpp"
#include "io/mcap/records.hpp"
#include "io/mcap/summary.hpp"

namespace godwit::io::mcap {

namespace {

result<std::uint32_t> crc_between(const byte_source& source, std::uint64_t begin, std::uint64_t end) {
  byte_buffer block(std::size_t{64} << 10);
  std::uint32_t crc = 0;
  while (begin < end) {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(block.size(), end - begin));
    const result<std::size_t> got = source.read_at(begin, std::span{block}.first(wanted));
    if (!got) {
      return tl::make_unexpected(got.error());
    }
    if (*got == 0) {
      break; // the file has shrunk meanwhile; the CRC will not match
    }
    crc = crc_of(byte_view{block}.first(*got), crc);
    begin += *got;
  }
  return crc;
}

} // namespace

result<bool> has_end(const byte_source& source) {
  constexpr std::size_t end_bytes = footer_bytes + magic.size();
  const std::uint64_t size_bytes = source.size_bytes();
  if (size_bytes < magic.size() + end_bytes) {
    return false;
  }
  std::array<std::byte, end_bytes> end;
  const std::uint64_t footer_offset = size_bytes - end_bytes;
  if (const auto got = source.read_at(footer_offset, end); !got || *got != end_bytes) {
    return got ? result<bool>{false} : tl::make_unexpected(got.error());
  }
  const byte_view bytes{end};
  const bool is_footer = bytes[0] == static_cast<std::byte>(opcode::footer) &&
                         load<std::uint64_t>(bytes.data() + 1) == footer_bytes - record_prefix_bytes;
  if (!is_footer || !std::ranges::equal(bytes.last(magic.size()), magic)) {
    return false;
  }
  const auto footer = parse_footer(bytes.subspan(record_prefix_bytes, footer_bytes - record_prefix_bytes));
  if (!footer || footer->summary_start > footer_offset) {
    return false;
  }
  if (footer->summary_crc == 0) {
    return true;
  }
  const std::uint64_t begin = footer->summary_start == 0 ? footer_offset : footer->summary_start;
  const std::uint64_t crc_offset = footer_offset + footer_bytes - sizeof(std::uint32_t);
  return crc_between(source, begin, crc_offset).map([&](std::uint32_t crc) { return crc == footer->summary_crc; });
}

result<completion> complete(const std::filesystem::path& path, read_limits limits) {
  file_source source;
  if (auto opened = source.open(path); !opened) {
    return tl::make_unexpected(opened.error());
  }
  const result<bool> whole = has_end(source);
  if (!whole) {
    return tl::make_unexpected(whole.error());
  }
  if (*whole) {
    return completion{.was_complete = true};
  }
  const result<completion_plan> plan = plan_completion(source, limits);
  if (!plan) {
    return tl::make_unexpected(plan.error());
  }
  output_file file;
  return file.open_and_cut(path, plan->keep_bytes)
      .and_then([&] { return file.append(plan->tail); })
      .and_then([&] { return file.close(); })
      .map([&] {
        return completion{false, plan->messages, source.size_bytes() - plan->keep_bytes, plan->tail.size()};
      });
}

namespace {

class scanner {
public:
  scanner(const byte_source& source, read_limits limits)
      : source_{source}, reader_{source, limits}, definitions_{limits} {}

  result<completion_plan> run() {
    if (result<void> read = read_data_section(); !read) {
      return tl::make_unexpected(read.error());
    }
    return make_plan();
  }

private:
  // The last chunk that was read; its index entry is complete when the first record after its message index comes.
  struct open_chunk {
    chunk_index_entry entry;
    std::uint32_t crc_after = 0; // of the file up to the end of the chunk
  };

  result<void> read_data_section();
  result<bool> on_record(const raw_record& raw);
  result<void> on_chunk(const raw_record& raw);
  result<void> on_content(const raw_record& raw, std::uint64_t offset_in_chunk, bool in_chunk);
  result<void> on_message_index(const raw_record& raw);
  void close_chunk();
  bool index_is_whole() const { return chunk_->entry.index_offsets.size() == index_.channel_count(); }
  bool is_torn(const error& damage, const raw_record& raw) const;
  completion_plan make_plan();

  tl::unexpected<error> malformed(const raw_record& raw, std::string what) const {
    return tl::make_unexpected(reader_.failure(errc::malformed, raw.offset, std::move(what)));
  }

  const byte_source& source_;
  record_reader reader_;
  definitions definitions_;
  summary summary_;
  chunk_cursor::memory memory_;
  message_index index_; // of chunk_
  std::optional<open_chunk> chunk_;
  bool has_header_ = false;
  std::uint64_t keep_bytes_ = 0;
  std::uint32_t keep_crc_ = 0;
};

result<void> scanner::read_data_section() {
  const auto start = reader_.read_magic();
  if (!start) {
    return tl::make_unexpected(start.error());
  }
  if (std::holds_alternative<truncated>(*start)) {
    return {};
  }
  for (;;) {
    const auto found = reader_.next();
    if (!found) {
      return tl::make_unexpected(found.error());
    }
    const auto* raw = std::get_if<raw_record>(&*found);
    if (raw == nullptr) {
      return {};
    }
    const result<bool> more = on_record(*raw);
    if (!more && !is_torn(more.error(), *raw)) {
      return tl::make_unexpected(more.error());
    }
    if (!more || !*more) {
      return {};
    }
    keep_bytes_ = raw->offset + raw->whole.size();
    keep_crc_ = crc_of(raw->whole, reader_.crc());
  }
}

bool scanner::is_torn(const error& damage, const raw_record& raw) const {
  // Damage deeper inside of a chunk whose CRC holds was written like that: no torn end, and not ours to cut.
  const bool whole_record = damage.offset_bytes == raw.offset;
  const bool at_end = raw.offset + raw.whole.size() >= source_.size_bytes();
  return has_header_ && at_end && whole_record && (damage.code == errc::malformed || damage.code == errc::crc_mismatch);
}

// False at the end of the data section: what follows is made anew.
result<bool> scanner::on_record(const raw_record& raw) {
  if (!has_header_) {
    if (raw.op != opcode::header || !parse_header(raw.content())) {
      return malformed(raw, "no header");
    }
    has_header_ = true;
    return true;
  }
  if (raw.op != opcode::message_index) {
    close_chunk();
  }
  const auto proceed = [] { return true; };
  switch (raw.op) {
  case opcode::chunk:
    return on_chunk(raw).map(proceed);
  case opcode::message_index:
    return on_message_index(raw).map(proceed);
  case opcode::schema:
  case opcode::channel:
  case opcode::message:
    return on_content(raw, 0, false).map(proceed);
  case opcode::metadata: {
    const auto record = parse_metadata(raw.content());
    if (!record) {
      return malformed(raw, "metadata record");
    }
    summary_.add_metadata(raw.offset, raw.whole.size(), record->name);
    return true;
  }
  case opcode::attachment:
    return tl::make_unexpected(reader_.failure(errc::unsupported, raw.offset, "attachment in a file to be completed"));
  case opcode::data_end:
    return false;
  case opcode::header:
  case opcode::footer:
  case opcode::chunk_index:
  case opcode::attachment_index:
  case opcode::statistics:
  case opcode::metadata_index:
  case opcode::summary_offset:
    return malformed(raw, "not allowed in the data section");
  }
  return true; // unknown: kept as it is
}

result<void> scanner::on_chunk(const raw_record& raw) {
  auto cursor = chunk_cursor::open(reader_, raw, memory_);
  if (!cursor) {
    return tl::make_unexpected(cursor.error());
  }
  for (;;) {
    const auto inner = cursor->next();
    if (!inner) {
      return tl::make_unexpected(inner.error());
    }
    if (!*inner) {
      break;
    }
    if (auto taken = on_content(**inner, cursor->offset_in_chunk(**inner), true); !taken) {
      return taken;
    }
  }
  open_chunk chunk;
  chunk.entry.start_time_ns = index_.start_time_ns();
  chunk.entry.end_time_ns = index_.end_time_ns();
  chunk.entry.chunk_offset = raw.offset;
  chunk.entry.chunk_bytes = raw.whole.size();
  chunk.entry.records_bytes = cursor->records_bytes();
  chunk.entry.compressed_bytes = cursor->compressed_bytes();
  chunk.entry.compression = cursor->compression();
  chunk.crc_after = crc_of(raw.whole, reader_.crc());
  chunk_ = std::move(chunk);
  return {};
}

result<void> scanner::on_content(const raw_record& raw, std::uint64_t offset_in_chunk, bool in_chunk) {
  const auto define = [&](const auto& record, auto add) -> result<void> {
    if (!record) {
      return malformed(raw, "fields do not fit");
    }
    return definitions_.add(reader_, raw, *record).map([&](bool is_new) {
      if (is_new) {
        (summary_.*add)(raw.whole);
      }
    });
  };
  switch (raw.op) {
  case opcode::schema:
    return define(parse_schema(raw.content()), &summary::add_schema);
  case opcode::channel:
    return define(parse_channel(raw.content()), &summary::add_channel);
  case opcode::message: {
    const auto message = parse_message(raw.content());
    if (!message || !definitions_.has(message->channel)) {
      return malformed(raw, "message record");
    }
    if (in_chunk) {
      index_.add(message->channel, message->log_time_ns, offset_in_chunk);
    } else {
      summary_.add_message(*message);
    }
    return {};
  }
  default:
    return {};
  }
}

result<void> scanner::on_message_index(const raw_record& raw) {
  const auto record = parse_message_index(raw.content());
  if (!record || !chunk_ || !index_.has(record->channel) ||
      !chunk_->entry.index_offsets.emplace(record->channel, raw.offset).second) {
    return malformed(raw, "message index record");
  }
  chunk_->entry.index_bytes += raw.whole.size();
  return {};
}

void scanner::close_chunk() {
  if (chunk_) {
    summary_.add_chunk(chunk_->entry, index_);
    chunk_.reset();
    index_.clear();
  }
}

completion_plan scanner::make_plan() {
  completion_plan plan;
  plan.keep_bytes = keep_bytes_;
  std::uint32_t crc = keep_crc_;
  if (!has_header_) {
    plan.keep_bytes = 0;
    crc = 0;
    append_opening(plan.tail);
  } else if (chunk_ && !index_is_whole()) {
    // The writer was stopped within the message index of its last chunk: it is made anew from the chunk.
    plan.keep_bytes = chunk_->entry.chunk_offset + chunk_->entry.chunk_bytes;
    crc = chunk_->crc_after;
    chunk_->entry.index_offsets.clear();
    index_.append_records(plan.tail, plan.keep_bytes, chunk_->entry);
  }
  close_chunk();
  crc = crc_of(plan.tail, crc);
  summary_.append_tail(plan.tail, plan.keep_bytes + plan.tail.size(), crc);
  plan.messages = summary_.statistics().message_count;
  return plan;
}

} // namespace

result<completion_plan> plan_completion(const byte_source& source, read_limits limits) {
  return scanner{source, limits}.run();
}

} // namespace godwit::io::mcap
