#include "io/mcap/format.hpp"

#include <gtest/gtest.h>

#include "io/mcap/error.hpp"
#include "io/mcap/records.hpp"

namespace godwit::io::mcap {
namespace format_test {

TEST(mcap_format, integers_are_little_endian_and_come_back) {
  byte_buffer out;
  append_integer(out, std::uint32_t{0x01020304});
  append_integer(out, std::uint64_t{0xF1F2F3F4F5F6F7F8});
  EXPECT_EQ(out[0], std::byte{4});
  EXPECT_EQ(out[3], std::byte{1});
  EXPECT_EQ(load<std::uint32_t>(out.data()), 0x01020304U);
  EXPECT_EQ(load<std::uint64_t>(out.data() + 4), 0xF1F2F3F4F5F6F7F8U);
}

TEST(mcap_format, a_field_longer_than_its_record_is_refused_at_every_cut) {
  byte_buffer out;
  append_channel(out, {channel_id{3}, schema_id{2}, "/topic", "json", {{"a", "b"}}});
  const byte_view content = byte_view{out}.subspan(record_prefix_bytes);
  ASSERT_TRUE(parse_channel(content));
  EXPECT_EQ(parse_channel(content)->metadata.at("a"), "b");
  for (std::size_t length = 0; length < content.size(); ++length) {
    EXPECT_FALSE(parse_channel(content.first(length))) << length;
  }
}

TEST(mcap_format, fields_added_by_a_later_version_are_ignored) {
  byte_buffer out;
  append_schema(out, {schema_id{1}, "name", "jsonschema", bytes_of("{}")});
  append_string(out, "of a later version");
  const auto schema = parse_schema(byte_view{out}.subspan(record_prefix_bytes));
  ASSERT_TRUE(schema);
  EXPECT_EQ(schema->name, "name");
}

TEST(mcap_format, an_error_names_file_offset_and_cause) {
  const error damage{errc::crc_mismatch, "a.mcap", "chunk", 77};
  EXPECT_EQ(damage.message(), "a.mcap: CRC mismatch at byte 77: chunk");
  const error full = system_error("b.mcap", "write", ENOSPC);
  EXPECT_EQ(full.code, errc::disk_full);
  EXPECT_EQ(full.message(), "b.mcap: disk full: write: No space left on device");
}

} // namespace format_test
} // namespace godwit::io::mcap
