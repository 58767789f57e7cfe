#include "actors/domain/mission/convert/item_list_import.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "io/mavlink/enums.hpp"

namespace godwit::mission {
namespace item_list_import_test {

using io::mavlink::mav_cmd;
using io::mavlink::mission_item_int;

mission_item_int item_of(std::uint16_t seq, mav_cmd command, std::uint8_t in_frame = frame::global_relative_int) {
  mission_item_int result;
  result.seq = seq;
  result.command = io::mavlink::number(command);
  result.frame = in_frame;
  result.autocontinue = 1;
  result.x = 473'977'420;
  result.y = 85'455'940 + seq * 1'000;
  result.z = 20;
  return result;
}

item_list_options options() {
  item_list_options result;
  result.mission_id = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";
  result.vehicle = vehicle_profile::arducopter;
  return result;
}

std::vector<mission_item_int> short_list() {
  auto speed = item_of(1, mav_cmd::do_change_speed, frame::mission);
  speed.param2 = 5;
  return {item_of(0, mav_cmd::nav_takeoff), speed, item_of(2, mav_cmd::nav_waypoint),
          item_of(3, mav_cmd::nav_return_to_launch, frame::mission)};
}

TEST(import_item_list, each_item_knows_its_place_in_the_upload) {
  const auto result = import_item_list(short_list(), options());
  ASSERT_TRUE(result.has_value()) << result.error().message();
  ASSERT_EQ(result->mission.items.size(), 4U);
  EXPECT_EQ(result->places, (std::vector<std::uint16_t>{0, 1, 2, 3}));
  EXPECT_EQ(std::get<waypoint>(result->mission.items[2]).at, (position{47.397742, 8.545794, 20}));
  EXPECT_EQ(result->mission.revision, 1);
}

TEST(import_item_list, an_item_with_an_infinite_number_is_refused_and_nan_is_as_usual) {
  for (const auto command : {mav_cmd::nav_waypoint, mav_cmd::nav_loiter_time, mav_cmd::nav_takeoff, mav_cmd::nav_land})
    for (const auto param :
         {&mission_item_int::param1, &mission_item_int::param2, &mission_item_int::param3, &mission_item_int::param4}) {
      auto items = short_list();
      items[2] = item_of(2, command);
      items[2].param1 = 1;
      items[2].*param = std::numeric_limits<float>::infinity();
      const auto result = import_item_list(items, options());
      ASSERT_FALSE(result.has_value()) << static_cast<int>(command);
      EXPECT_NE(result.error().message().find("infinite"), std::string::npos) << result.error().message();
    }
  auto items = short_list();
  items[2].param1 = std::numeric_limits<float>::quiet_NaN();
  const auto usual = import_item_list(items, options());
  ASSERT_TRUE(usual.has_value()) << usual.error().message();
  EXPECT_EQ(std::get<waypoint>(usual->mission.items[2]).hold_s, 0);
}

TEST(import_item_list, what_no_mission_may_hold_is_a_loss_and_left_out_only_when_that_is_allowed) {
  auto items = short_list();
  items.insert(items.begin() + 2, item_of(2, mav_cmd::do_parachute, frame::mission));
  items[3].seq = 3;
  items[4].seq = 4;
  const auto strict = import_item_list(items, options());
  ASSERT_FALSE(strict.has_value());
  EXPECT_NE(strict.error().message().find("DO_PARACHUTE"), std::string::npos) << strict.error().message();
  EXPECT_NE(strict.error().message().find("flight.allowed_commands"), std::string::npos) << strict.error().message();
  auto lenient = options();
  lenient.allow_partial = true;
  const auto result = import_item_list(items, lenient);
  ASSERT_TRUE(result.has_value()) << result.error().message();
  EXPECT_EQ(result->places, (std::vector<std::uint16_t>{0, 1, 3, 4}));
  EXPECT_EQ(result->losses.all.size(), 1U);
  auto allowing = options();
  allowing.allowed = {208};
  EXPECT_EQ(import_item_list(items, allowing)->mission.items.size(), 5U);
}

TEST(import_item_list, a_jump_leads_to_the_item_of_its_number_and_one_to_nowhere_is_a_loss) {
  auto items = short_list();
  auto back = item_of(3, mav_cmd::do_jump, frame::mission);
  back.param1 = 2;
  back.param2 = 3;
  items.insert(items.begin() + 3, back);
  items[4].seq = 4;
  const auto result = import_item_list(items, options());
  ASSERT_TRUE(result.has_value()) << result.error().message();
  EXPECT_EQ(result->mission.items[3], item(jump{"item-4", "item-3", 3}));
  EXPECT_EQ(result->mission.schema_version, "2.0.0");
  items[3].param1 = 9;
  EXPECT_EQ(import_item_list(items, options()).error().losses.message(),
            "item 3: DO_JUMP: jump to item 9; the mission has no such item; instead: left out");
  items[3].param1 = 3;
  EXPECT_NE(import_item_list(items, options()).error().message().find("leads to itself"), std::string::npos);
}

TEST(import_item_list, heights_above_the_sea_and_above_terrain_go_to_the_vehicle_as_they_came) {
  for (const std::uint8_t in : {0, 5, 10}) {
    auto items = short_list();
    items[2].frame = in;
    items[2].z = 520;
    const auto result = import_item_list(items, options());
    ASSERT_TRUE(result.has_value()) << result.error().message();
    const auto& point = std::get<command_item>(result->mission.items[2]);
    EXPECT_EQ(point.command, 16);
    EXPECT_EQ(point.frame, in);
    EXPECT_EQ(point.params[6], 520);
  }
}

TEST(import_item_list, a_place_in_a_frame_that_vehicles_read_otherwise_is_a_loss) {
  for (const std::uint8_t in : {1, 2, 8}) {
    auto items = short_list();
    items[2].frame = in;
    EXPECT_FALSE(import_item_list(items, options()).has_value()) << int{in};
  }
}

TEST(import_item_list, a_return_to_launch_stays_one_of_the_vehicle) {
  const auto result = import_item_list(short_list(), options());
  ASSERT_TRUE(result.has_value()) << result.error().message();
  EXPECT_EQ(result->mission.items.back(), item(return_home{"item-4", return_goal::home}));
  EXPECT_EQ(result->mission.return_point, std::nullopt);
}

TEST(import_item_list, what_is_wrong_names_the_item_of_the_upload) {
  auto items = short_list();
  items[2].param1 = -5;
  EXPECT_EQ(import_item_list(items, options()).error().message(),
            "the upload (item 2, NAV_WAYPOINT, \"item-3\"): hold_s is -5; allowed: a number from 0 to 86400");
}

TEST(import_item_list, a_list_that_makes_no_mission_is_refused) {
  EXPECT_FALSE(import_item_list({}, options()).has_value());
}

std::vector<mission_item_int> corners(std::uint16_t first, mav_cmd command, int count) {
  std::vector<mission_item_int> result;
  for (int i = 0; i < count; ++i) {
    result.push_back(item_of(static_cast<std::uint16_t>(first + i), command));
    result.back().param1 = static_cast<float>(count);
    result.back().x += i % 2 * 5'000;
  }
  return result;
}

TEST(import_fence_list, polygons_are_runs_of_corners_and_circles_become_polygons) {
  auto items = corners(0, mav_cmd::nav_fence_polygon_vertex_inclusion, 4);
  const auto second = corners(4, mav_cmd::nav_fence_polygon_vertex_exclusion, 3);
  items.insert(items.end(), second.begin(), second.end());
  items.push_back(item_of(7, mav_cmd::nav_fence_circle_exclusion));
  items.back().param1 = 25;
  const auto result = import_fence_list(items);
  ASSERT_TRUE(result.has_value()) << result.error();
  ASSERT_EQ(result->geofences.size(), 3U);
  EXPECT_EQ(result->geofences[0].kind, fence_kind::inclusion);
  EXPECT_EQ(result->geofences[0].vertices.size(), 4U);
  EXPECT_EQ(result->geofences[1].kind, fence_kind::exclusion);
  EXPECT_EQ(result->geofences[1].vertices.size(), 3U);
  EXPECT_EQ(result->geofences[1].vertices[0], (vertex{47.397742, 8.545994}));
  EXPECT_EQ(result->geofences[2].vertices.size(), 32U);
  EXPECT_EQ(result->breach_return_point, std::nullopt);
  EXPECT_TRUE(import_fence_list({})->geofences.empty());
}

// As MAVProxy uploads a .fen file; QGroundControl has it at the end.
TEST(import_fence_list, the_point_to_which_a_breach_leads_is_kept_wherever_it_stands) {
  for (const bool is_first : {true, false}) {
    auto items = corners(0, mav_cmd::nav_fence_polygon_vertex_inclusion, 4);
    auto point = item_of(4, mav_cmd::nav_fence_return_point);
    point.z = std::numeric_limits<float>::quiet_NaN();
    items.insert(is_first ? items.begin() : items.end(), point);
    const auto result = import_fence_list(items);
    ASSERT_TRUE(result.has_value()) << result.error();
    EXPECT_EQ(result->geofences.size(), 1U);
    ASSERT_TRUE(result->breach_return_point.has_value());
    EXPECT_EQ(result->breach_return_point->latitude, point.x * 1e-7);
    EXPECT_EQ(result->breach_return_point->altitude_m, 0);
  }
}

TEST(import_fence_list, what_is_no_fence_is_refused_and_named) {
  const auto sentence_for = [](const std::vector<mission_item_int>& items) {
    const auto result = import_fence_list(items);
    return result ? std::string("it was taken") : result.error();
  };
  auto cut = corners(0, mav_cmd::nav_fence_polygon_vertex_inclusion, 4);
  cut.pop_back();
  EXPECT_EQ(sentence_for(cut), "item 0 of the fence begins a polygon of 4 corners");
  auto mixed = corners(0, mav_cmd::nav_fence_polygon_vertex_inclusion, 3);
  mixed[2].command = io::mavlink::number(mav_cmd::nav_fence_polygon_vertex_exclusion);
  EXPECT_EQ(sentence_for(mixed), "item 0 of the fence begins a polygon that is not complete");
  EXPECT_EQ(sentence_for(corners(3, mav_cmd::nav_fence_polygon_vertex_inclusion, 2)),
            "item 3 of the fence begins a polygon of 2 corners");
  EXPECT_EQ(sentence_for({item_of(0, mav_cmd::nav_waypoint)}),
            "item 0 of the fence is neither a corner nor a circle (NAV_WAYPOINT)");
  auto point = item_of(0, mav_cmd::nav_fence_circle_inclusion);
  EXPECT_EQ(sentence_for({point}), "item 0 of the fence is a circle of 0 m, of which no polygon is made");
  point.param1 = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(sentence_for({point}), "it was taken");
}

} // namespace item_list_import_test
} // namespace godwit::mission
