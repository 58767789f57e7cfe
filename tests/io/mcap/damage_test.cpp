// Every cut and every flipped bit of a small recording: what a reader and a repair make of it.
#include <algorithm>

#include <gtest/gtest.h>

#include "io/mcap/repair.hpp"
#include "tests/io/mcap/mcap_fixture.hpp"

namespace godwit::io::mcap::test {
namespace damage_test {

// End offset of each chunk, found without the reader under test: the chunks of the small recording have four messages.
std::uint32_t whole_messages_in(byte_view file, std::size_t cut_at) {
  std::uint32_t messages = 0;
  std::size_t at = magic.size();
  while (at + record_prefix_bytes <= cut_at) {
    const auto op = static_cast<opcode>(file[at]);
    at += record_prefix_bytes + static_cast<std::size_t>(load<std::uint64_t>(file.data() + at + 1));
    if (op == opcode::data_end) {
      break;
    }
    messages += op == opcode::chunk && at <= cut_at ? 4 : 0;
  }
  return messages;
}

class mcap_damage : public testing::TestWithParam<bool> {
protected:
  byte_buffer recording() const {
    write_small_recording(folder_ / "whole.mcap", GetParam());
    return load_bytes(folder_ / "whole.mcap");
  }
  temporary_folder folder_;
};

INSTANTIATE_TEST_SUITE_P(closed_and_open, mcap_damage, testing::Bool(),
                         [](const auto& parameter) { return parameter.param ? "closed" : "open"; });

TEST_P(mcap_damage, cut_at_any_byte_the_reader_gives_exactly_the_whole_messages) {
  const byte_buffer file = recording();
  for (std::size_t cut_at = 0; cut_at < file.size(); ++cut_at) {
    const reading seen = read_all(byte_view{file}.first(cut_at));
    ASSERT_EQ(seen.end, ending::truncated) << cut_at << ": " << seen.failure.message();
    ASSERT_EQ(seen.torn.file_bytes, cut_at);
    ASSERT_LE(seen.torn.record_offset, cut_at);
    ASSERT_EQ(seen.messages.size(), whole_messages_in(file, cut_at)) << cut_at;
    for (std::uint32_t n = 0; n < seen.messages.size(); ++n) {
      ASSERT_EQ(seen.messages[n], numbered(n));
    }
  }
}

TEST_P(mcap_damage, cut_at_any_byte_it_is_completed_with_exactly_the_whole_messages) {
  const byte_buffer file = recording();
  const auto path = folder_ / "cut.mcap";
  for (std::size_t cut_at = 0; cut_at < file.size(); ++cut_at) {
    store_bytes(path, byte_view{file}.first(cut_at));
    const std::uint32_t expected = whole_messages_in(file, cut_at);
    const result<completion> done = complete(path);
    ASSERT_TRUE(done) << cut_at << ": " << done.error().message();
    EXPECT_FALSE(done->was_complete);
    EXPECT_EQ(done->messages, expected);
    const reading seen = read_file(path);
    ASSERT_EQ(seen.end, ending::complete) << cut_at << ": " << seen.failure.message();
    ASSERT_EQ(seen.messages.size(), expected) << cut_at;
    ASSERT_EQ(seen.statistics.message_count, expected);
    ASSERT_EQ(seen.statistics.chunk_count, expected / 4);
    const byte_buffer completed = load_bytes(path);
    const result<completion> again = complete(path);
    ASSERT_TRUE(again);
    EXPECT_TRUE(again->was_complete);
    ASSERT_EQ(load_bytes(path), completed);
  }
}

TEST_P(mcap_damage, zeros_instead_of_the_rest_count_as_cut) {
  const byte_buffer file = recording();
  for (std::size_t cut_at = magic.size(); cut_at < file.size(); cut_at += 13) {
    byte_buffer damaged = file;
    std::fill(damaged.begin() + static_cast<std::ptrdiff_t>(cut_at), damaged.end(), std::byte{0});
    const reading seen = read_all(damaged);
    EXPECT_NE(seen.end, ending::complete) << cut_at;
    EXPECT_LE(seen.messages.size(), whole_messages_in(file, cut_at));
  }
}

// The data section, the summary and every chunk have a CRC, and what these do not cover is checked by its structure.
TEST(mcap_damage_closed, every_single_flipped_bit_is_noticed) {
  const temporary_folder folder;
  write_small_recording(folder / "whole.mcap", true);
  byte_buffer file = load_bytes(folder / "whole.mcap");
  for (std::size_t bit = 0; bit < file.size() * 8; ++bit) {
    const auto mask = static_cast<std::byte>(1U << (bit % 8));
    file[bit / 8] ^= mask;
    const reading seen = read_all(file);
    ASSERT_NE(seen.end, ending::complete) << "bit " << bit % 8 << " of byte " << bit / 8;
    static_cast<void>(plan_completion(memory_source{file})); // must not crash
    file[bit / 8] ^= mask;
  }
}

TEST(mcap_damage_closed, damage_with_data_after_it_is_reported_and_left_alone) {
  const temporary_folder folder;
  const auto path = folder / "open.mcap";
  write_small_recording(path, false);
  byte_buffer file = load_bytes(path);
  file[file.size() / 4] ^= std::byte{1}; // in the first chunk
  store_bytes(path, file);
  const result<completion> done = complete(path);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, errc::crc_mismatch);
  EXPECT_EQ(done.error().file, path.string());
  EXPECT_EQ(load_bytes(path), file);
}

TEST(mcap_damage_closed, a_damaged_last_chunk_is_cut) {
  const temporary_folder folder;
  const auto path = folder / "open.mcap";
  write_small_recording(path, false);
  byte_buffer file = load_bytes(path);
  std::size_t chunk_end = 0; // of the last chunk, whose message index is left away
  for (std::size_t at = magic.size(); at < file.size();) {
    const bool is_chunk = static_cast<opcode>(file[at]) == opcode::chunk;
    at += record_prefix_bytes + static_cast<std::size_t>(load<std::uint64_t>(file.data() + at + 1));
    chunk_end = is_chunk ? at : chunk_end;
  }
  file.resize(chunk_end);
  file[chunk_end - 5] ^= std::byte{1};
  store_bytes(path, file);
  const result<completion> done = complete(path);
  ASSERT_TRUE(done) << done.error().message();
  EXPECT_EQ(done->messages, 8U);
  EXPECT_EQ(read_file(path).end, ending::complete);
}

} // namespace damage_test
} // namespace godwit::io::mcap::test
