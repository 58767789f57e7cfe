#include "tests/support/strict_mcap_reader.hpp"

#include <utility>

#include "io/mcap/format.hpp"

namespace godwit::io::mcap {

result<strict_mcap_reader::item> strict_mcap_reader::next() {
  while (!last_) {
    step s = part_ == part::start ? step_start() : part_ == part::end ? step_end() : step_file();
    if (!s) {
      last_ = tl::make_unexpected(s.error());
    } else if (*s) {
      item found = std::move(**s);
      if (!std::holds_alternative<end_of_file>(found) && !std::holds_alternative<truncated>(found)) {
        return found;
      }
      last_ = std::move(found);
    }
  }
  return *last_;
}

strict_mcap_reader::step strict_mcap_reader::malformed(const raw_record& raw, std::string what) const {
  what += " (opcode " + std::to_string(static_cast<int>(raw.op)) + ")";
  return tl::make_unexpected(reader_.failure(errc::malformed, raw.offset, std::move(what)));
}

strict_mcap_reader::step strict_mcap_reader::step_start() {
  const auto found = reader_.read_magic();
  if (!found) {
    return tl::make_unexpected(found.error());
  }
  if (const auto* torn = std::get_if<truncated>(&*found)) {
    return item{truncated{0, torn->file_bytes}};
  }
  part_ = part::header;
  return std::nullopt;
}

strict_mcap_reader::step strict_mcap_reader::step_file() {
  if (chunk_) {
    const auto inner = chunk_->next();
    if (!inner) {
      return tl::make_unexpected(inner.error());
    }
    if (*inner) {
      return on_content(**inner);
    }
    chunk_.reset();
  }
  const auto found = reader_.next();
  if (!found) {
    return tl::make_unexpected(found.error());
  }
  if (const auto* torn = std::get_if<truncated>(&*found)) {
    // Without a whole header nothing of the file can be kept.
    return item{part_ == part::header ? truncated{0, torn->file_bytes} : *torn};
  }
  return on_record(std::get<raw_record>(*found));
}

strict_mcap_reader::step strict_mcap_reader::step_end() {
  const auto found = reader_.read_magic();
  if (!found) {
    return tl::make_unexpected(found.error());
  }
  if (const auto* torn = std::get_if<truncated>(&*found)) {
    return item{*torn};
  }
  return reader_.at_end().and_then([this](bool at_end) -> step {
    const std::uint64_t file_bytes = end_offset_ + magic.size();
    if (!at_end) {
      return tl::make_unexpected(reader_.failure(errc::malformed, file_bytes, "bytes after the end of the file"));
    }
    return item{end_of_file{file_bytes}};
  });
}

// Which records may stand where: the table of the specification's sections.
strict_mcap_reader::step strict_mcap_reader::on_record(const raw_record& raw) {
  if ((part_ == part::header) != (raw.op == opcode::header)) {
    return malformed(raw, "the header must be the first record, and only that");
  }
  const bool in_data = part_ == part::data;
  switch (raw.op) {
  case opcode::header:
    return on_header(raw);
  case opcode::schema:
  case opcode::channel:
    return on_content(raw);
  case opcode::message:
  case opcode::metadata:
    return in_data ? on_content(raw) : malformed(raw, "data after the data section");
  case opcode::chunk: {
    if (!in_data) {
      return malformed(raw, "data after the data section");
    }
    auto opened = chunk_cursor::open(reader_, raw, memory_);
    if (!opened) {
      return tl::make_unexpected(opened.error());
    }
    chunk_ = *opened;
    return std::nullopt;
  }
  case opcode::message_index:
  case opcode::attachment:
    return in_data ? step{std::nullopt} : malformed(raw, "data after the data section");
  case opcode::data_end:
    return in_data ? on_data_end(raw) : malformed(raw, "second end of the data section");
  case opcode::chunk_index:
  case opcode::attachment_index:
  case opcode::metadata_index:
  case opcode::summary_offset:
    return in_data ? malformed(raw, "summary inside of the data section") : step{std::nullopt};
  case opcode::statistics:
    return in_data ? malformed(raw, "summary inside of the data section") : on_content(raw);
  case opcode::footer:
    return in_data ? malformed(raw, "footer without an end of the data section") : on_footer(raw);
  }
  return std::nullopt; // of a later version of the format, or of an application: to be skipped
}

strict_mcap_reader::step strict_mcap_reader::on_header(const raw_record& raw) {
  const auto record = parse_header(raw.content());
  if (!record) {
    return malformed(raw, "fields do not fit");
  }
  part_ = part::data;
  return item{*record};
}

strict_mcap_reader::step strict_mcap_reader::on_content(const raw_record& raw) {
  const auto tell = [&](auto record) -> step {
    return record ? step{item{std::move(*record)}} : malformed(raw, "fields do not fit");
  };
  const auto define = [&](auto record) -> step {
    if (!record) {
      return malformed(raw, "fields do not fit");
    }
    const result<bool> is_new = definitions_.add(reader_, raw, *record);
    if (!is_new) {
      return tl::make_unexpected(is_new.error());
    }
    return *is_new ? step{item{std::move(*record)}} : step{std::nullopt};
  };
  switch (raw.op) {
  case opcode::schema:
    return define(parse_schema(raw.content()));
  case opcode::channel:
    return define(parse_channel(raw.content()));
  case opcode::metadata:
    return tell(parse_metadata(raw.content()));
  case opcode::statistics:
    return tell(parse_statistics(raw.content()));
  case opcode::message: {
    const auto record = parse_message(raw.content());
    if (record && !definitions_.has(record->channel)) {
      return malformed(raw, "message before its channel");
    }
    return tell(record);
  }
  default:
    return std::nullopt;
  }
}

strict_mcap_reader::step strict_mcap_reader::on_data_end(const raw_record& raw) {
  const auto record = parse_data_end(raw.content());
  if (!record) {
    return malformed(raw, "fields do not fit");
  }
  if (record->crc != 0 && record->crc != reader_.crc()) {
    return tl::make_unexpected(reader_.failure(errc::crc_mismatch, raw.offset, "data section"));
  }
  reader_.restart_crc();
  part_ = part::summary;
  summary_start_ = raw.offset + raw.whole.size();
  return std::nullopt;
}

strict_mcap_reader::step strict_mcap_reader::on_footer(const raw_record& raw) {
  const auto record = parse_footer(raw.content());
  if (!record) {
    return malformed(raw, "fields do not fit");
  }
  const byte_view covered = raw.whole.first(raw.whole.size() - sizeof(std::uint32_t));
  if (record->summary_crc != 0 && record->summary_crc != crc_of(covered, reader_.crc())) {
    return tl::make_unexpected(reader_.failure(errc::crc_mismatch, raw.offset, "summary"));
  }
  if (record->summary_start != 0 && record->summary_start != summary_start_) {
    return malformed(raw, "the footer points elsewhere than to the summary");
  }
  part_ = part::end;
  end_offset_ = raw.offset + raw.whole.size();
  return std::nullopt;
}

} // namespace godwit::io::mcap
