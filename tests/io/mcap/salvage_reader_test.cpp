#include "io/mcap/salvage_reader.hpp"

#include <algorithm>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "io/mcap/file_summary.hpp"
#include "io/mcap/records.hpp"
#include "tests/io/mcap/mcap_fixture.hpp"

namespace godwit::io::mcap::test {
namespace salvage_reader_test {

struct salvaged {
  std::vector<seen_message> messages;
  std::vector<unreadable> lost;
  std::uint64_t file_bytes = 0;

  [[nodiscard]] bool is_cut() const {
    return std::ranges::any_of(lost, [](const unreadable& each) { return each.is_cut; });
  }
};

salvaged salvage(byte_view bytes) {
  const memory_source source{bytes, "memory"};
  std::map<channel_id, std::string> topics;
  if (const auto summary = read_summary(source); summary && *summary) {
    for (const auto& each : (*summary)->channels) {
      topics[each.id] = each.topic;
    }
  }
  salvaged result;
  salvage_reader reader{source};
  for (;;) {
    const auto item = reader.next();
    EXPECT_TRUE(item.has_value());
    if (const auto* channel = std::get_if<channel_record>(&*item)) {
      topics[channel->id] = channel->topic;
    } else if (const auto* message = std::get_if<message_record>(&*item)) {
      const auto* text = reinterpret_cast<const char*>(message->data.data());
      result.messages.push_back(
          {topics[message->channel], message->sequence, message->log_time_ns, std::string(text, message->data.size())});
    } else if (const auto* lost = std::get_if<unreadable>(&*item)) {
      result.lost.push_back(*lost);
    } else if (const auto* end = std::get_if<end_of_file>(&*item)) {
      result.file_bytes = end->file_bytes;
      return result;
    }
  }
}

class mcap_salvage : public testing::TestWithParam<bool> {
protected:
  byte_buffer recording() const {
    write_small_recording(folder_ / "whole.mcap", GetParam());
    return load_bytes(folder_ / "whole.mcap");
  }
  temporary_folder folder_;
};

INSTANTIATE_TEST_SUITE_P(closed_and_open, mcap_salvage, testing::Bool(),
                         [](const auto& parameter) { return parameter.param ? "closed" : "open"; });

bool holds_only_what_was_written(const salvaged& seen) {
  return std::ranges::all_of(
      seen.messages, [](const seen_message& each) { return each == numbered(each.sequence) || each.topic.empty(); });
}

TEST_P(mcap_salvage, a_whole_file_is_read_to_its_end) {
  const auto seen = salvage(recording());
  ASSERT_EQ(seen.messages.size(), small_recording_messages);
  for (std::uint32_t n = 0; n < seen.messages.size(); ++n) {
    EXPECT_EQ(seen.messages[n], numbered(n));
  }
  EXPECT_EQ(seen.lost.empty(), GetParam());
  EXPECT_EQ(seen.is_cut(), !GetParam());
}

TEST_P(mcap_salvage, a_cut_is_named_and_costs_no_chunk_before_it) {
  const byte_buffer file = recording();
  for (std::size_t cut_at = 0; cut_at < file.size(); ++cut_at) {
    const auto whole = read_all(byte_view{file}.first(cut_at)).messages.size();
    const auto seen = salvage(byte_view{file}.first(cut_at));
    ASSERT_EQ(seen.messages.size(), whole) << cut_at;
    ASSERT_TRUE(holds_only_what_was_written(seen)) << cut_at;
    ASSERT_FALSE(seen.lost.empty()) << cut_at;
    ASSERT_EQ(seen.lost.back().offset + seen.lost.back().bytes, cut_at);
  }
}

TEST_P(mcap_salvage, a_flipped_byte_costs_at_most_its_chunk_and_what_is_lost_is_told) {
  const byte_buffer whole = recording();
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const auto mask : {std::byte{1}, std::byte{0xff}}) {
      byte_buffer file = whole;
      file[at] ^= mask;
      const auto seen = salvage(file);
      ASSERT_GE(seen.messages.size() + 4, small_recording_messages) << at;
      ASSERT_TRUE(holds_only_what_was_written(seen)) << at;
      if (seen.messages.size() < small_recording_messages) {
        ASSERT_TRUE(std::ranges::any_of(seen.lost, [](const auto& each) { return each.may_hold_messages; })) << at;
      }
    }
  }
}

// Records that the format allows and nobody here writes: what stands after them is not lost.
byte_buffer with_records_in_front_of_messages(const byte_buffer& records) {
  const two_channels channels;
  byte_buffer file;
  append_opening(file);
  append_channel(file, {channel_id{1}, schema_id{0}, "/even", "json", {}});
  append_bytes(file, records);
  for (std::uint32_t n = 0; n < 3; ++n) { // outside of chunks, so that no CRC leads to them
    const auto start = begin_record(file, opcode::message);
    append_integer(file, std::uint16_t{1});
    append_integer(file, n);
    append_integer(file, std::uint64_t{1000});
    append_integer(file, std::uint64_t{1000});
    append_bytes(file, bytes_of(payload_of(n)));
    end_record(file, start);
  }
  return file;
}

TEST(mcap_salvage, a_record_of_a_later_version_costs_nothing_after_it) {
  byte_buffer unknown;
  const auto start = begin_record(unknown, opcode{0x23});
  append_string(unknown, "of a later version");
  end_record(unknown, start);
  const auto file = with_records_in_front_of_messages(unknown);
  EXPECT_EQ(read_all(file).messages.size(), 3U);
  EXPECT_EQ(salvage(file).messages.size(), 3U);
}

TEST(mcap_salvage, an_index_with_two_different_sizes_costs_nothing_after_it) {
  for (const auto said : {std::uint32_t{16}, std::uint32_t{48}, std::uint32_t{0xFFFF'FFFF}}) {
    byte_buffer index;
    const auto start = begin_record(index, opcode::message_index);
    append_integer(index, std::uint16_t{1});
    append_integer(index, said);
    index.resize(index.size() + 2 * message_index_entry_bytes);
    end_record(index, start);
    const auto file = with_records_in_front_of_messages(index);
    EXPECT_EQ(salvage(file).messages.size(), 3U) << said;
  }
}

// Of each file that the strict reader reads to its end the other one reads as much.
TEST(mcap_salvage, finds_no_less_than_the_strict_reader_in_damaged_files) {
  const temporary_folder folder;
  write_small_recording(folder / "whole.mcap", true);
  const auto whole = load_bytes(folder / "whole.mcap");
  const int rounds = 20'000;
  std::mt19937 dice(1);
  int compared = 0;
  for (int n = 0; n < rounds; ++n) {
    auto file = whole;
    for (auto changes = 1 + dice() % 3; changes > 0; --changes) {
      file[dice() % file.size()] = static_cast<std::byte>(dice());
    }
    const auto strict = read_all(file);
    if (strict.end == ending::error) {
      continue;
    }
    ++compared;
    ASSERT_GE(salvage(file).messages.size(), strict.messages.size()) << "round " << n;
  }
  EXPECT_GT(compared, rounds / 100);
}

TEST(mcap_salvage, a_file_that_is_no_mcap_is_lost_as_a_whole) {
  const std::string text(100'000, '\x06');
  const auto seen = salvage(bytes_of(text));
  EXPECT_TRUE(seen.messages.empty());
  ASSERT_EQ(seen.lost.size(), 1U);
  EXPECT_EQ(seen.lost[0].bytes, text.size());
}

TEST(mcap_salvage, two_files_in_one_are_both_read) {
  const temporary_folder folder;
  write_small_recording(folder / "a.mcap", true);
  const byte_buffer once = load_bytes(folder / "a.mcap");
  byte_buffer twice = once;
  append_bytes(twice, once);
  const auto seen = salvage(twice);
  EXPECT_EQ(seen.messages.size(), 2 * small_recording_messages);
  EXPECT_EQ(seen.lost.size(), 1U) << "that there is more after the end";
}

TEST(mcap_file_summary, only_a_sound_end_gives_one) {
  const temporary_folder folder;
  write_small_recording(folder / "closed.mcap", true);
  write_small_recording(folder / "open.mcap", false);
  byte_buffer closed = load_bytes(folder / "closed.mcap");
  const auto summary = read_summary(memory_source{closed});
  ASSERT_TRUE(summary.has_value() && summary->has_value());
  ASSERT_TRUE((*summary)->statistics.has_value());
  EXPECT_EQ((*summary)->statistics->message_count, small_recording_messages);
  EXPECT_EQ((*summary)->channels.size(), 2U);
  closed[closed.size() - 60] ^= std::byte{1};
  EXPECT_FALSE(read_summary(memory_source{closed})->has_value());
  const byte_buffer open = load_bytes(folder / "open.mcap");
  EXPECT_FALSE(read_summary(memory_source{open})->has_value());
}

} // namespace salvage_reader_test
} // namespace godwit::io::mcap::test
