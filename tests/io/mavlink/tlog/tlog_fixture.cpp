#include "tests/io/mavlink/tlog/tlog_fixture.hpp"

#include <cstdlib>
#include <stdexcept>

#include <gtest/gtest.h>

#include "io/mavlink/crc.hpp"
#include "io/mavlink/ids.hpp"

namespace godwit::io::mavlink::test {

namespace fs = std::filesystem;

temporary_folder::temporary_folder() {
  std::string pattern = (fs::temp_directory_path() / "godwit-tlog-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr)
    throw std::runtime_error("mkdtemp: " + pattern);
  path_ = pattern;
}

temporary_folder::~temporary_folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

reading read_all(const mcap::byte_source& source) {
  reading seen;
  tlog_reader reader(source);
  std::uint64_t after_last = 0;
  for (;;) {
    const auto record = reader.next();
    if (!record)
      throw std::runtime_error(record.error().message());
    if (!*record)
      break;
    const frame_view& frame = (*record)->frame;
    const message_info* const info = find_message(frame.id());
    EXPECT_EQ((*record)->is_verified, info != nullptr);
    EXPECT_TRUE(info == nullptr || crc_matches(frame, info->crc_extra));
    EXPECT_GE((*record)->offset_bytes, after_last);
    after_last = (*record)->offset_bytes + frame.size();
    seen.records.push_back({(*record)->timestamp_us, to_hex(frame.bytes()), (*record)->is_verified});
  }
  EXPECT_LE(after_last, source.size_bytes());
  seen.counts = reader.counts();
  EXPECT_FALSE(reader.next()->has_value());
  EXPECT_EQ(seen.counts.frames + seen.counts.unknown_ids, seen.records.size());
  return seen;
}

reading read_bytes(byte_view bytes) { return read_all(mcap::memory_source(bytes)); }

reading read_file(const fs::path& path) {
  mcap::file_source file;
  if (const auto opened = file.open(path); !opened)
    throw std::runtime_error(opened.error().message());
  return read_all(file);
}

log_builder& log_builder::time(std::uint64_t timestamp_us) {
  std::array<std::byte, tlog_time_size> bytes;
  store_tlog_time(bytes, timestamp_us);
  return raw(bytes);
}

log_builder& log_builder::raw(byte_view bytes) {
  append(bytes_, bytes);
  return *this;
}

byte_buffer unknown_frame(std::size_t payload_size) {
  byte_buffer payload(payload_size, std::byte{0x55});
  const frame_buffer frame(0xFFFFF0, 17, payload, {1, 1}, 0, false);
  return {frame.span().begin(), frame.span().end()};
}

byte_buffer with_flags(byte_buffer frame, std::uint8_t incompat) {
  frame[incompat_at] = std::byte{incompat};
  const frame_view view(frame.data());
  const std::size_t length = view.payload().size();
  const auto crc = frame_crc(view.bytes().subspan(1, header_size - 1 + length), find_message(view.id())->crc_extra);
  std::memcpy(frame.data() + header_size + length, &crc, crc_size);
  return frame;
}

byte_buffer v1_frame() {
  byte_buffer frame = from_hex("fe0900010100000000000208510403");
  const auto crc = frame_crc(byte_view(frame).subspan(1), heartbeat::crc_extra);
  append(frame, std::as_bytes(std::span(&crc, 1)));
  return frame;
}

} // namespace godwit::io::mavlink::test
