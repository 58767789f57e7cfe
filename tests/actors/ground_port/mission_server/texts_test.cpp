#include "actors/ground_port/mission_server/texts.hpp"

#include <array>

#include <gtest/gtest.h>

#include "io/mavlink/messages/heartbeat.hpp"

namespace godwit::ground_port::mission_server {
namespace texts_test {

constexpr std::size_t room_in_statustext = io::mavlink::statustext{}.text.size();

TEST(texts, are_filled_with_what_happened) {
  text_facts facts;
  facts.type = 1;
  facts.who = {255, 190};
  facts.whom = {1, 191};
  facts.count = 12;
  facts.item = 3;
  facts.room = 1'000;
  facts.reason = mavlink::mav_mission_result::invalid_param5_x;
  EXPECT_EQ(filled("{plan} {count}: {who}, {whom}; {item} of {room}, {reason}", facts),
            "Fence 12: 255/190, 1/191; 3 of 1000, invalid param5 x");
  EXPECT_EQ(filled("nothing to fill", facts), "nothing to fill");
  facts.type = 77;
  EXPECT_EQ(filled("{plan}", facts), "Plan of type 77");
}

// Long ones would come in parts, which many ground stations show as two sentences.
TEST(texts, each_fits_into_one_message_whatever_it_is_filled_with) {
  text_facts longest;
  longest.who = {255, 255};
  longest.whom = {255, 255};
  longest.count = 65'535;
  longest.item = 65'535;
  longest.room = 65'535;
  longest.reason = mavlink::mav_mission_result::operation_cancelled;
  for (const std::uint8_t type : {0, 1, 2, 255})
    for (const auto table : {plain_texts(), px4_texts(), ardupilot_texts()})
      for (const auto& row : table) {
        longest.type = type;
        EXPECT_LE(filled(row.text, longest).size(), room_in_statustext) << row.text;
      }
}

TEST(texts, each_occasion_has_one_sentence_at_most_for_a_type_of_plan) {
  for (const auto table : {plain_texts(), px4_texts(), ardupilot_texts()})
    for (std::size_t i = 0; i < table.size(); ++i)
      for (std::size_t j = i + 1; j < table.size(); ++j)
        EXPECT_FALSE(table[i].when == table[j].when && (table[i].type == table[j].type || !table[i].type))
            << table[i].text;
}

} // namespace texts_test
} // namespace godwit::ground_port::mission_server
