#include "programs/godwit-sim/vehicle/autopilot/outlet.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "io/mavlink/messages/clock.hpp"
#include "io/mavlink/messages/heartbeat.hpp"

namespace godwit::sim {
namespace outlet_test {

class outlet_to_a_list {
public:
  explicit outlet_to_a_list(bool numbers_each_text = false)
      : out(
            {9, 1}, [this](std::span<const std::byte> bytes) { frames.emplace_back(bytes.begin(), bytes.end()); },
            numbers_each_text) {}

  [[nodiscard]] std::vector<mavlink::statustext> texts() const {
    std::vector<mavlink::statustext> result;
    for (const auto& each : frames)
      result.push_back(mavlink::decode<mavlink::statustext>(mavlink::frame_view(each.data())));
    return result;
  }
  [[nodiscard]] std::string words() const {
    std::string result;
    for (const auto& each : texts())
      result.append(each.text.begin(), std::find(each.text.begin(), each.text.end(), '\0'));
    return result;
  }

  std::vector<std::vector<std::byte>> frames;
  outlet out;
};

TEST(outlet, numbers_its_frames_and_names_their_sender) {
  outlet_to_a_list list;
  for (int i = 0; i < 300; ++i)
    list.out.send(mavlink::ping{});
  const mavlink::frame_view last(list.frames.back().data());
  EXPECT_EQ(last.sequence(), 299 % 256);
  EXPECT_EQ(last.from(), (mavlink::sender{9, 1}));
}

TEST(outlet, says_a_sentence_at_the_end_of_the_turn) {
  outlet_to_a_list list;
  list.out.say(mavlink::mav_severity::info, "Mission started");
  EXPECT_TRUE(list.frames.empty());
  list.out.end_turn();
  EXPECT_EQ(list.words(), "Mission started");
  list.out.end_turn();
  EXPECT_EQ(list.frames.size(), 1U);
}

TEST(outlet, gives_a_long_sentence_in_parts_with_one_id) {
  outlet_to_a_list list;
  const std::string sentence(120, 'x');
  list.out.say(mavlink::mav_severity::info, sentence);
  list.out.end_turn();
  const auto texts = list.texts();
  ASSERT_EQ(texts.size(), 3U);
  EXPECT_EQ(list.words(), sentence);
  EXPECT_NE(texts[0].id, 0);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    EXPECT_EQ(texts[i].id, texts[0].id);
    EXPECT_EQ(texts[i].chunk_seq, i);
  }
}

TEST(outlet, numbers_each_sentence_where_it_is_told_to) {
  outlet_to_a_list list(true);
  for (int i = 0; i < 3; ++i)
    list.out.say(mavlink::mav_severity::info, "short");
  list.out.end_turn();
  EXPECT_EQ(list.texts().back().id, 2);
}

TEST(outlet, keeps_the_newest_sentences_while_they_are_held_back) {
  outlet_to_a_list list;
  list.out.hold_texts_back(true);
  for (std::size_t i = 0; i < outlet::max_waiting_texts + 5; ++i) {
    list.out.say(mavlink::mav_severity::info, std::to_string(i));
    list.out.end_turn();
  }
  EXPECT_TRUE(list.frames.empty());
  list.out.hold_texts_back(false);
  list.out.end_turn();
  EXPECT_EQ(list.frames.size(), outlet::max_waiting_texts);
  EXPECT_EQ(list.texts().front().text[0], '5');
}

TEST(outlet, says_nothing_while_it_is_silent_and_begins_anew_after_a_restart) {
  outlet_to_a_list list(true);
  list.out.send(mavlink::ping{});
  list.out.say(mavlink::mav_severity::info, "one");
  list.out.be_silent(true);
  list.out.restart();
  list.out.send(mavlink::ping{});
  list.out.say(mavlink::mav_severity::info, "lost");
  list.out.end_turn();
  EXPECT_EQ(list.frames.size(), 1U);
  list.out.be_silent(false);
  list.out.send(mavlink::ping{});
  EXPECT_EQ(mavlink::frame_view(list.frames.back().data()).sequence(), 0);
}

} // namespace outlet_test
} // namespace godwit::sim
