#include <gtest/gtest.h>

#include "actors/ground_port/station_table.hpp"
#include "tests/support/time_units.hpp"

namespace godwit::ground_port {

namespace station_table_test {

using godwit::tests::s;
constexpr mavlink::heartbeat station_beat{.type = 6};

mavlink::sender numbered(int i) { return {static_cast<std::uint8_t>(100 + i), 190}; }

TEST(station_table, a_station_is_reached_by_the_way_that_it_came_last) {
  station_table table;
  EXPECT_EQ(table.way_to({255, 190}), io::link::every_peer);
  EXPECT_NE(table.hear({255, 190}, 7, 0), nullptr);
  EXPECT_EQ(table.way_to({255, 190}), 7U);
  EXPECT_NE(table.hear({255, 190}, 9, 0), nullptr);
  EXPECT_EQ(table.way_to({255, 190}), 9U);
  EXPECT_EQ(table.all().size(), 1U);
}

TEST(station_table, when_it_is_full_a_newcomer_is_refused_while_all_others_are_there) {
  station_table table;
  for (int i = 0; i < 16; ++i)
    EXPECT_NE(table.hear(numbered(i), 1, i), nullptr);
  EXPECT_EQ(table.hear({255, 190}, 1, 4 * s), nullptr);
  EXPECT_EQ(table.refused(), 1U);
}

TEST(station_table, when_it_is_full_the_one_that_was_silent_longest_makes_room) {
  station_table table;
  for (int i = 0; i < 16; ++i)
    EXPECT_NE(table.hear(numbered(i), 1, 0), nullptr);
  for (int i = 1; i < 16; ++i)
    EXPECT_NE(table.hear(numbered(i), 1, 5 * s), nullptr);
  EXPECT_NE(table.hear({255, 190}, 1, 5 * s), nullptr);
  EXPECT_EQ(table.evicted(), 1U);
  EXPECT_EQ(table.way_to(numbered(0)), io::link::every_peer);
  EXPECT_EQ(table.all().size(), 16U);
}

TEST(station_table, only_heartbeats_of_ground_stations_are_the_operators_link) {
  station_table table;
  auto* const other = table.hear({255, 191}, 1, 0);
  table.note_heartbeat(*other, mavlink::heartbeat{.type = 18}, 0);
  EXPECT_FALSE(table.operator_now(0).ever_heard);
  auto* const station = table.hear({255, 190}, 1, s);
  table.note_heartbeat(*station, station_beat, s);
  EXPECT_EQ(table.operator_now(3 * s).age_ms, 2'000);
  EXPECT_EQ(table.operator_now(3 * s).stations, 1U);
}

TEST(station_table, the_operators_age_outlives_the_place_in_the_table) {
  station_table table;
  table.note_heartbeat(*table.hear({255, 190}, 1, 0), station_beat, 0);
  for (int i = 0; i < 16; ++i)
    (void)table.hear(numbered(i), 1, 10 * s);
  EXPECT_EQ(table.operator_now(10 * s).age_ms, 10'000);
  EXPECT_TRUE(table.operator_now(10 * s).ever_heard);
}

TEST(station_table, where_anybody_can_speak_three_heartbeats_are_no_operator_and_the_fourth_by_one_way_is) {
  station_table table(4);
  for (int i = 0; i < 3; ++i) {
    table.note_heartbeat(*table.hear({255, 190}, 1, i * s), station_beat, i * s);
    table.note_heartbeat(*table.hear({255, 190}, static_cast<io::link::peer_id>(i + 2), i * s), station_beat, i * s);
  }
  EXPECT_FALSE(table.operator_now(3 * s).ever_heard);
  EXPECT_EQ(table.operator_now(3 * s).stations, 0U);
  table.note_heartbeat(*table.hear({255, 190}, 1, 3 * s), station_beat, 3 * s);
  EXPECT_TRUE(table.operator_now(3 * s).ever_heard);
}

} // namespace station_table_test

namespace station_rules_test {

using mavlink::mav_result;
using operators::role;

TEST(ground_port_rules, without_operators_beside_them_stations_may_say_everything) {
  EXPECT_FALSE(station_rules(std::nullopt).look());
}

TEST(ground_port_rules, an_operator_may_while_nobody_has_control_and_not_before_that_is_known) {
  station_rules rules(role::operator_);
  EXPECT_EQ(rules.look()->result, mav_result::temporarily_rejected) << "not known yet";
  rules.on_control("");
  EXPECT_FALSE(rules.look());
  rules.on_control("anna");
  EXPECT_EQ(rules.look()->result, mav_result::temporarily_rejected);
  EXPECT_EQ(rules.look()->why, "anna has control");
  rules.on_control("");
  EXPECT_FALSE(rules.look());
}

TEST(ground_port_rules, a_viewer_may_not_whoever_has_control) {
  station_rules rules(role::viewer);
  EXPECT_EQ(rules.look()->result, mav_result::denied);
  rules.on_control("");
  EXPECT_EQ(rules.look()->result, mav_result::denied);
}

} // namespace station_rules_test

} // namespace godwit::ground_port
