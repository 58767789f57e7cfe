#include "actors/domain/mission/rules.hpp"

#include <limits>

#include <cmath>

#include <gtest/gtest.h>

#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/write.hpp"

namespace godwit::mission {
namespace rules_test {

constexpr const char* some_uuid = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";
constexpr const char* other_uuid = "0b8f7c36-3a5f-4c0b-8f0e-5e5f2f6f9b11";
constexpr const char* some_time = "2026-05-04T10:15:30Z";

progress_report report(std::uint32_t number) {
  return {some_uuid, 2, 1, number, progress_kind::reached, "w1", 1, some_time, false};
}

std::string problems_of(const auto& value) {
  std::string text;
  for (const auto& each : broken_rules(value))
    text += each.message() + '\n';
  return text;
}

// Every kind of document: written and read it is the same.
template <class T>
void expect_same_again(const T& value) {
  const auto text = to_text(value);
  const auto again = read<T>(text);
  ASSERT_TRUE(again.has_value()) << again.error().message() << '\n' << text;
  EXPECT_EQ(*again, value) << text;
}

TEST(rules, a_number_that_is_not_finite_is_never_handed_on) {
  document mission;
  mission.items = {waypoint{"w", {1, std::numeric_limits<double>::infinity(), 3}, 0, 0, {}}};
  mission.return_point = position{1, 2, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_EQ(problems_of(mission), "/items/0/at/longitude is no finite number\n"
                                  "/return_point/altitude_m is no finite number\n");
}

TEST(rules, a_return_point_may_be_absent_only_when_no_item_leads_there) {
  document mission;
  mission.items = {waypoint{"w", {1, 2, 3}, 0, 0, {}}, return_home{"r", return_goal::home}};
  EXPECT_EQ(problems_of(mission), "");
  mission.items.emplace_back(return_home{"back", {}});
  EXPECT_EQ(problems_of(mission), "/return_point is missing; allowed: a position: an item returns there\n");
}

TEST(rules, an_assignment_has_a_revision_above_its_base) {
  assignment value{some_uuid, 4, 4, "w1", {return_home{"r"}}};
  EXPECT_EQ(problems_of(value), "/revision is 4, and base_revision 4; allowed: a revision above base_revision\n");
  value.revision = 5;
  expect_same_again(value);
  expect_same_again(assignment_list{{value}});
  expect_same_again(assignment_list{});
}

TEST(rules, assignments_come_oldest_first) {
  const assignment value{some_uuid, 4, 5, {}, {return_home{"r"}}};
  EXPECT_EQ(problems_of(assignment_list{{value, value}}),
            "/assignments/1/revision is not above the one before it; allowed: the oldest first\n");
}

TEST(rules, a_rejection_has_a_reason) {
  assignment_response value{some_uuid, assignment_outcome::rejected, {}, report(3), 7};
  EXPECT_EQ(problems_of(value), "/reason is missing; allowed: a text, since it was rejected\n");
  value.reason = "base revision 2 is not the one in memory";
  expect_same_again(value);
}

TEST(rules, an_insert_holds_a_waypoint_and_nothing_else) {
  waypoint_insert value{some_uuid, 3, "w1", waypoint{"new", {47, 8, 30}, 0, 2, {}}};
  expect_same_again(value);
  value.waypoint = return_home{"r"};
  EXPECT_FALSE(read<waypoint_insert>(to_text(value)).has_value());
}

TEST(rules, a_tail_holds_items_with_different_ids) {
  tail value{some_uuid, 3, {}, {return_home{"a"}, return_home{"a"}}, "click to fly"};
  EXPECT_EQ(problems_of(value), "/items/1/id is \"a\", as of item 0; allowed: an id that no other item has\n");
  value.items.pop_back();
  expect_same_again(value);
}

TEST(rules, reports_follow_each_other_without_a_gap_and_are_of_one_mission) {
  progress_batch value{some_uuid, {report(4), report(5)}};
  expect_same_again(value);
  value.reports[1].report_no = 6;
  value.reports[1].mission_id = other_uuid;
  EXPECT_EQ(problems_of(value), "/reports/1/report_no is 6 after 4; allowed: numbers without a gap\n"
                                "/reports/1/mission_id is another than before; allowed: one mission in a batch\n");
}

TEST(rules, a_report_names_an_item_by_id_and_index_or_not_at_all) {
  auto value = report(1);
  expect_same_again(value);
  value.item_index.reset();
  EXPECT_EQ(problems_of(value), "the document has only one of item_id and item_index; allowed: both or none\n");
  value.item_id.reset();
  EXPECT_EQ(problems_of(value), "the document does not name its item; allowed: item_id and item_index\n");
  value.kind = progress_kind::complete;
  expect_same_again(value);
}

TEST(rules, a_time_has_to_exist) {
  auto value = report(1);
  value.at = "2026-02-30T10:15:30Z";
  EXPECT_EQ(problems_of(value),
            "/at is \"2026-02-30T10:15:30Z\"; allowed: a day and time that exist, from 1678 to 2261\n");
}

TEST(rules, map_objects_stand_once_in_a_page) {
  const map_object object{some_uuid, "vehicle", 47, 8, {}, 0.5, some_time, some_time};
  expect_same_again(map_object_page{"1.0.0", {object}, "2000"});
  EXPECT_EQ(problems_of(map_object_page{"1.0.0", {object, object}, {}}),
            "/map_objects/1/object_id stands twice in this list\n");
  expect_same_again(map_object_page{"1.0.0", {object}, {}, "m-1", std::vector{object.object_id}, "m-2"});
  EXPECT_NE(problems_of(map_object_page{"1.0.0", {}, {}, {}, std::vector{object.object_id}, {}}).find("/removed"),
            std::string::npos);
  EXPECT_EQ(problems_of(map_object_page{"3.0.0", {}, {}}),
            "/schema_version is \"3.0.0\"; allowed: versions 1.x.y and 2.x.y\n");
}

TEST(rules, ignored_items_have_an_mgrs_cell) {
  ignored_item value{some_uuid, "32TMT6543251234", "vehicle", some_time};
  expect_same_again(ignored_item_batch{some_uuid, {value}});
  expect_same_again(ignored_item_page{"1.0.0", {value}, {}});
  expect_same_again(map_object_bundle{"1.0.0", some_time, true, {}, {value}});
  for (const auto* polar : {"YZG1234567890", "BAN"}) {
    value.mgrs_cell = polar;
    expect_same_again(ignored_item_batch{some_uuid, {value}});
  }
  for (const auto* wrong : {"32TM", "32IMT12", "32TMT123", "XYZ12"}) {
    value.mgrs_cell = wrong;
    EXPECT_FALSE(read<ignored_item_batch>(to_text(ignored_item_batch{some_uuid, {value}})).has_value()) << wrong;
  }
}

TEST(rules, only_a_new_or_ignored_observation_may_have_no_object) {
  observation value{other_uuid, {}, observation_kind::fresh, "vehicle", 47, 8, 400.5, 0.9, some_time};
  expect_same_again(observation_batch{some_uuid, {value}});
  value.kind = observation_kind::moved;
  EXPECT_EQ(problems_of(observation_batch{some_uuid, {value}}),
            "/observations/0/object_id is missing; allowed: a UUID: only a new one has none\n");
}

TEST(rules, a_problem_may_say_more_than_we_know) {
  const auto value = read<problem>(
      R"({"title": "Gone", "status": 410, "trace": {"id": 5}, "errors": [{"pointer": "", "detail": "deleted"}]})");
  ASSERT_TRUE(value.has_value()) << value.error().message();
  EXPECT_EQ(value->status, 410);
  EXPECT_EQ(value->errors.at(0).detail, "deleted");
  expect_same_again(receipt{3, 4});
}

document looping(std::vector<item> items) {
  document result;
  result.mission_id = some_uuid;
  result.schema_version = schema_version_2;
  result.items = std::move(items);
  return result;
}

command_item command_of(const char* id, std::uint16_t number) { return {id, number, 2, {1, 0, 0, 0, 0, 0, 0}, true}; }

std::string faults_of(const document& mission) {
  std::string text;
  for (const auto& each : broken_rules(mission))
    text += each.message() + '\n';
  return text;
}

TEST(rules, the_camera_of_a_survey_is_triggered_by_distance_or_by_time) {
  survey area{"s", {{47, 8}, {47, 8.01}, {47.01, 8}}, 50, 20, {}, survey_camera{}};
  const auto fault = " allowed: `distance_m` or `interval_s`\n";
  EXPECT_EQ(faults_of(looping({area})), std::string("/items/0/camera/trigger has neither;") + fault);
  area.camera->trigger = {10, 2};
  EXPECT_EQ(faults_of(looping({area})),
            std::string("/items/0/camera/trigger has `distance_m` and `interval_s`;") + fault);
  area.camera->trigger = {10, {}};
  EXPECT_EQ(faults_of(looping({area})), "");
}

TEST(rules, a_jump_leads_to_another_item_of_the_mission) {
  const waypoint there{"w", {47, 8, 20}, 0, 0, {}};
  EXPECT_EQ(faults_of(looping({there, jump{"j", "w", 2}})), "");
  EXPECT_EQ(faults_of(looping({there, jump{"j", "x", 2}})),
            "/items/1/to is \"x\", which no item is called; allowed: the id of an item\n");
  EXPECT_EQ(faults_of(looping({there, jump{"j", "j", 2}})),
            "/items/1/to leads to itself; allowed: the id of another item\n");
}

TEST(rules, a_loop_without_an_end_has_an_item_that_moves_the_vehicle) {
  const waypoint there{"w", {47, 8, 20}, 0, 0, {}};
  const auto wait = command_of("d", 93);
  EXPECT_EQ(faults_of(looping({there, wait, jump{"j", "w", -1}})), "");
  EXPECT_EQ(faults_of(looping({there, wait, jump{"j", "d", 7}})), "") << "it ends";
  EXPECT_EQ(
      faults_of(looping({there, wait, jump{"j", "d", -1}})),
      "/items/2/to leads back for ever, and no item in between moves the vehicle; allowed: an item that moves it\n");
}

TEST(rules, a_vehicle_belongs_to_version_2) {
  auto mission = looping({waypoint{"w", {47, 8, 30}, 0, 0, {}}});
  mission.vehicle = vehicle_profile::arducopter;
  EXPECT_EQ(faults_of(mission), "");
  mission.schema_version = "1.0.0";
  EXPECT_EQ(faults_of(mission), "/schema_version is \"1.0.0\", and circles, rally points, a point of return of the "
                                "fence and a vehicle are of version 2; allowed: 2.0.0\n");
}

TEST(rules, commands_and_jumps_belong_to_version_2) {
  auto mission = looping({command_of("c", 206)});
  EXPECT_EQ(faults_of(mission), "");
  mission.schema_version = "1.0.0";
  EXPECT_EQ(faults_of(mission), "/schema_version is \"1.0.0\", and item \"c\" is of kind command; allowed: 2.0.0\n");
}

TEST(rules, the_place_of_a_command_is_on_earth_and_finite) {
  command_item point{"c", 16, 0, {0, 0, 0, 0, 95, 181, 20}, true};
  EXPECT_EQ(faults_of(looping({point})), "/items/0/params/4 is 95; allowed: a number from -90 to 90\n"
                                         "/items/0/params/5 is 181; allowed: a number from -180 to 180\n");
  point.params[4] = std::nan("");
  point.params[5] = 8;
  EXPECT_EQ(faults_of(looping({point})), "/items/0/params/4 is no finite number\n");
}

} // namespace rules_test
} // namespace godwit::mission
