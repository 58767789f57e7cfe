#include "io/mcap/salvage_reader.hpp"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "io/mcap/file_summary.hpp"
#include "tests/io/mcap/mcap_fixture.hpp"

namespace godwit::io::mcap::test {
namespace {

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
  EXPECT_EQ(seen.lost.size(), 1U) << "that there is more behind the end";
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

} // namespace
} // namespace godwit::io::mcap::test
