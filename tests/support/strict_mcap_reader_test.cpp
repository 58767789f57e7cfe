#include "tests/support/strict_mcap_reader.hpp"

#include <gtest/gtest.h>

#include "io/mcap/records.hpp"
#include "tests/io/mcap/mcap_fixture.hpp"

namespace godwit::io::mcap::test {
namespace strict_mcap_reader_test {

// A file of others: records outside of chunks, and whatever is put between opening and end.
byte_buffer file_with(const byte_buffer& data) {
  byte_buffer file;
  append_opening(file);
  append_bytes(file, data);
  append_data_end(file, 0);
  const std::size_t footer = begin_record(file, opcode::footer);
  file.resize(file.size() + footer_bytes - record_prefix_bytes);
  end_record(file, footer);
  append_bytes(file, magic);
  return file;
}

void append_message(byte_buffer& out, channel_id channel) {
  const std::size_t start = begin_record(out, opcode::message);
  append_integer(out, static_cast<std::uint16_t>(channel));
  out.resize(out.size() + message_fields_bytes - 2);
  end_record(out, start);
}

void append_chunk(byte_buffer& out, std::string_view compression, std::uint64_t uncompressed_bytes) {
  const std::size_t start = begin_record(out, opcode::chunk);
  append_integer(out, std::uint64_t{0});
  append_integer(out, std::uint64_t{0});
  append_integer(out, uncompressed_bytes);
  append_integer(out, std::uint32_t{0});
  append_string(out, compression);
  append_integer(out, std::uint64_t{3});
  append_bytes(out, bytes_of("xyz"));
  end_record(out, start);
}

TEST(strict_mcap_reader, messages_outside_of_chunks_are_read) {
  byte_buffer data;
  append_channel(data, {channel_id{0}, schema_id{0}, "/t", "json", {}});
  append_message(data, channel_id{0});
  const reading seen = read_all(file_with(data));
  EXPECT_EQ(seen.end, ending::complete) << seen.failure.message();
  EXPECT_EQ(seen.messages.size(), 1U);
}

TEST(strict_mcap_reader, another_compression_is_an_explicit_error) {
  byte_buffer data;
  append_chunk(data, "lz4", 100);
  const reading seen = read_all(file_with(data));
  EXPECT_EQ(seen.end, ending::error);
  EXPECT_EQ(seen.failure.code, errc::unsupported);
  EXPECT_NE(seen.failure.message().find("compression lz4 not supported"), std::string::npos);
}

TEST(strict_mcap_reader, what_can_not_be_decompressed_or_would_not_fit_is_an_error) {
  for (const auto claimed : {std::uint64_t{100}, std::uint64_t{1} << 62U}) {
    byte_buffer data;
    append_chunk(data, "zstd", claimed);
    const reading seen = read_all(file_with(data));
    EXPECT_EQ(seen.end, ending::error);
    EXPECT_EQ(seen.failure.code, errc::malformed);
  }
}

TEST(strict_mcap_reader, records_unknown_to_us_are_skipped) {
  byte_buffer data;
  const std::size_t start = begin_record(data, opcode{0x90});
  append_string(data, "of some application");
  end_record(data, start);
  EXPECT_EQ(read_all(file_with(data)).end, ending::complete);
}

TEST(strict_mcap_reader, rules_between_records_are_checked) {
  struct rule {
    const char* broken;
    byte_buffer data;
  };
  std::vector<rule> rules(5);
  rules[0].broken = "a message needs its channel";
  append_message(rules[0].data, channel_id{1});
  rules[1].broken = "a channel needs its schema";
  append_channel(rules[1].data, {channel_id{1}, schema_id{5}, "/t", "json", {}});
  rules[2].broken = "one id means one channel";
  append_channel(rules[2].data, {channel_id{1}, schema_id{0}, "/t", "json", {}});
  append_channel(rules[2].data, {channel_id{1}, schema_id{0}, "/u", "json", {}});
  rules[3].broken = "the summary comes after the data";
  append_statistics(rules[3].data, {});
  rules[4].broken = "a chunk has one size";
  append_chunk(rules[4].data, "", 4);
  for (const rule& r : rules) {
    const reading seen = read_all(file_with(r.data));
    EXPECT_EQ(seen.end, ending::error) << r.broken;
    EXPECT_EQ(seen.failure.code, errc::malformed) << r.broken;
  }
}

TEST(strict_mcap_reader, other_files_are_refused_at_their_first_bytes) {
  EXPECT_EQ(read_all(bytes_of("SQLite format 3")).failure.code, errc::malformed);
  EXPECT_EQ(read_all(byte_view{}).end, ending::truncated);
}

TEST(strict_mcap_reader, a_length_from_the_file_is_bounded_before_memory_is_taken) {
  byte_buffer file;
  append_opening(file);
  const std::size_t start = begin_record(file, opcode::chunk);
  store(file.data() + start + 1, std::uint64_t{1} << 60);
  const reading seen = read_all(file);
  EXPECT_EQ(seen.end, ending::error);
  EXPECT_EQ(seen.failure.offset_bytes, start);
}

TEST(strict_mcap_reader, definitions_are_bounded_together) {
  byte_buffer data;
  for (std::uint16_t i = 1; i < 40; ++i) {
    append_channel(data, {channel_id{i}, schema_id{0}, "/" + std::to_string(i), "json", {}});
  }
  EXPECT_EQ(read_all(file_with(data)).end, ending::complete);
  const reading seen = read_all(file_with(data), {.definitions_bytes = 300});
  EXPECT_EQ(seen.failure.code, errc::too_large);
}

TEST(strict_mcap_reader, the_end_and_an_error_are_given_again) {
  const byte_buffer file = file_with({});
  const memory_source source{file};
  strict_mcap_reader reader{source};
  for (int i = 0; i < 4; ++i) {
    const auto item = reader.next();
    ASSERT_TRUE(item);
    EXPECT_EQ(std::holds_alternative<end_of_file>(*item), i > 0);
  }
}

TEST(strict_mcap_reader, bytes_after_the_end_are_an_error) {
  byte_buffer file = file_with({});
  file.push_back(std::byte{1});
  EXPECT_EQ(read_all(file).end, ending::error);
}

} // namespace strict_mcap_reader_test
} // namespace godwit::io::mcap::test
