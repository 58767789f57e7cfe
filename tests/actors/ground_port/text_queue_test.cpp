#include "actors/ground_port/text_queue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace godwit::ground_port {
namespace text_queue_test {

using io::mavlink::mav_severity;

std::vector<text_queue::entry> all_due(text_queue& queue, std::int64_t now_ns) {
  std::vector<text_queue::entry> result;
  while (const auto next = queue.due(now_ns))
    result.push_back(*next);
  return result;
}

std::string text_of(const text_queue::entry& e) {
  return {e.frame.text.begin(), std::find(e.frame.text.begin(), e.frame.text.end(), '\0')};
}

TEST(text_queue, a_short_text_goes_out_at_once_in_one_frame) {
  text_queue queue;
  EXPECT_EQ(queue.next_due_ns(), std::numeric_limits<std::int64_t>::max());
  queue.put(mav_severity::warning, "Low", 3);
  const auto out = all_due(queue, 5);
  ASSERT_EQ(out.size(), 1U);
  EXPECT_EQ(text_of(out[0]), "Low");
  EXPECT_EQ(out[0].frame.severity, 4);
  EXPECT_EQ(out[0].frame.id, 0);
  EXPECT_EQ(out[0].to, 3U);
}

TEST(text_queue, a_text_of_50_characters_needs_no_nul) {
  text_queue queue;
  queue.put(mav_severity::info, std::string(50, 'x'));
  const auto out = all_due(queue, 0);
  ASSERT_EQ(out.size(), 1U);
  EXPECT_EQ(text_of(out[0]).size(), 50U);
}

TEST(text_queue, a_long_text_comes_in_pieces_of_one_id_and_ends_with_a_nul) {
  for (const std::size_t length : {51, 99, 100, 149, 150, 199}) {
    text_queue queue;
    queue.put(mav_severity::info, std::string(length, 'x'));
    const auto out = all_due(queue, 0);
    std::size_t sum = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
      EXPECT_EQ(out[i].frame.chunk_seq, i);
      EXPECT_NE(out[i].frame.id, 0);
      EXPECT_EQ(out[i].frame.id, out[0].frame.id);
      sum += text_of(out[i]).size();
    }
    EXPECT_EQ(sum, length);
    EXPECT_LT(text_of(out.back()).size(), 50U);
  }
}

TEST(text_queue, what_is_too_long_is_cut_off) {
  text_queue queue;
  queue.put(mav_severity::info, std::string(5'000, 'x'));
  EXPECT_EQ(all_due(queue, 0).size(), text_queue::max_frames_of_a_text);
}

TEST(text_queue, a_few_go_out_at_once_and_then_one_in_each_gap) {
  text_queue queue;
  for (int i = 0; i < 20; ++i)
    queue.put(mav_severity::info, "x");
  EXPECT_EQ(all_due(queue, 1'000'000'000).size(), static_cast<std::size_t>(text_queue::at_once));
  EXPECT_EQ(queue.next_due_ns(), 1'000'000'000 + text_queue::gap_ns);
  EXPECT_EQ(all_due(queue, 1'000'000'000 + text_queue::gap_ns).size(), 1U);
}

TEST(text_queue, when_it_is_full_the_newest_is_dropped_as_a_whole_and_counted) {
  text_queue queue;
  for (int i = 0; i < 31; ++i)
    queue.put(mav_severity::info, "x");
  queue.put(mav_severity::info, std::string(60, 'y'));
  EXPECT_EQ(queue.dropped(), 1U);
  queue.put(mav_severity::info, "x");
  EXPECT_EQ(queue.dropped(), 1U);
  queue.put(mav_severity::info, "x");
  EXPECT_EQ(queue.dropped(), 2U);
}

} // namespace text_queue_test
} // namespace godwit::ground_port
