// Whole flights with a camera and a load: what becomes of the acts, and how many pictures each line has.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "actors/domain/geo/geodesic.hpp"
#include "tests/actors/executor/flight_checks.hpp"
#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor {
namespace acts_flight_test {

using mission::act_outcome;
using mission::progress_kind;
using sim::personality;
using tests::flight_world;

constexpr personality flyers[] = {personality::px4, personality::ardupilot};

mission::item act(const std::string& id, io::mavlink::mav_cmd command, double p1, double p2, double p3) {
  return mission::command_item{id, io::mavlink::number(command), 2, {p1, p2, p3, 0, 0, 0, 0}, true};
}

// Up, a line of 60 m with a picture each 10 m, a picture at its end, a load that is released, home.
// AT_END: one more as the trigger is switched off.
mission::document photographing(personality who, bool at_end = false) {
  using io::mavlink::mav_cmd;
  auto result = tests::short_mission(who);
  result.schema_version = "2.1.0";
  const auto end = result.items.back();
  result.items = {result.items.front(),
                  tests::place(who, "entry", 30, 0),
                  act("on", mav_cmd::do_set_cam_trigg_dist, 10, 0, 1),
                  tests::place(who, "line", 30, 60),
                  act("off", mav_cmd::do_set_cam_trigg_dist, 0, 0, at_end ? 1 : 0),
                  tests::place(who, "still", 0, 60),
                  act("photo", mav_cmd::image_start_capture, 0, 0, 1),
                  tests::place(who, "yard", 0, 30),
                  act("drop", mav_cmd::do_gripper, 1, 0, 0),
                  end};
  return result;
}

const mission::progress_report* report_of(const flight_world& world, const std::string& id) {
  const mission::progress_report* found = nullptr;
  for (const auto& each : world.reports())
    if (each.item_id == id && mission::settles_item(each.kind)) {
      EXPECT_EQ(found, nullptr) << "'" << id << "' is reported twice";
      found = &each;
    }
  return found;
}

void expect_all_acts(flight_world& world, personality who, std::uint32_t fewest_pictures) {
  const auto* line = report_of(world, "line");
  ASSERT_NE(line, nullptr) << world.story();
  ASSERT_TRUE(line->pictures) << world.story();
  EXPECT_EQ(line->pictures->planned, 7U) << "with the one at its beginning";
  EXPECT_GE(line->pictures->taken, fewest_pictures) << world.story();
  EXPECT_LE(line->pictures->taken, 8U) << world.story();
  const auto* photo = report_of(world, "photo");
  ASSERT_NE(photo, nullptr) << world.story();
  EXPECT_EQ(photo->kind, progress_kind::passed);
  EXPECT_EQ(photo->outcome, act_outcome::confirmed) << world.story();
  const auto* drop = report_of(world, "drop");
  ASSERT_NE(drop, nullptr) << world.story();
  if (who == personality::ardupilot)
    EXPECT_EQ(drop->outcome, act_outcome::confirmed) << world.story();
  else
    EXPECT_FALSE(drop->outcome) << "a PX4 reports nothing of its gripper\n" << world.story();
}

TEST(acts_flight, pictures_and_a_release_are_confirmed_by_who_reports_them) {
  for (const auto who : flyers) {
    flight_world world({.who = who, .has_payload = true});
    world.load(photographing(who));
    ASSERT_TRUE(world.run_until([&] { return world.durable().status.now == phase::done; }, 900)) << world.story();
    expect_all_acts(world, who, 5);
    EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
  }
}

// All but the single one are those of the line, whoever reports first: the vehicle or its camera.
TEST(acts_flight, the_pictures_at_both_ends_of_a_line_are_counted_as_its_own) {
  for (const auto who : flyers) {
    flight_world world({.who = who, .has_payload = true});
    world.load(photographing(who, true));
    ASSERT_TRUE(world.run_until([&] { return world.durable().status.now == phase::done; }, 900)) << world.story();
    const auto* line = report_of(world, "line");
    ASSERT_TRUE(line != nullptr && line->pictures) << world.story();
    EXPECT_EQ(line->pictures->planned, 8U);
    EXPECT_EQ(line->pictures->taken, world.pictures().size() - 1) << world.story();
    EXPECT_GE(line->pictures->taken, 7U);
    EXPECT_FALSE(line->inferred && who == personality::ardupilot) << "its REACHED came";
    for (const auto* id : {"entry", "still", "yard"})
      EXPECT_FALSE(report_of(world, id)->pictures) << id << world.story();
  }
}

// Four seconds after the place, or ten metres before the next one: on the way in both cases.
TEST(acts_flight, a_release_that_a_condition_holds_back_is_confirmed) {
  using io::mavlink::mav_cmd;
  const auto who = personality::ardupilot;
  for (const auto& condition :
       {act("when", mav_cmd::condition_delay, 4, 0, 0), act("when", mav_cmd::condition_distance, 10, 0, 0)}) {
    flight_world world({.who = who, .has_payload = true});
    auto mission = photographing(who);
    mission.items = {mission.items.front(),
                     tests::place(who, "yard", 20, 0),
                     condition,
                     act("drop", mav_cmd::do_gripper, 1, 0, 0),
                     tests::place(who, "on", 20, 60),
                     mission.items.back()};
    world.load(mission);
    ASSERT_TRUE(world.run_until([&] { return world.durable().status.now == phase::done; }, 300)) << world.story();
    const auto* drop = report_of(world, "drop");
    ASSERT_NE(drop, nullptr) << world.story();
    EXPECT_EQ(drop->outcome, act_outcome::confirmed) << world.story();
    EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
  }
}

// The plan ends with it, in the air.
TEST(acts_flight, a_release_after_the_last_place_is_confirmed) {
  const auto who = personality::ardupilot;
  flight_world world({.who = who, .has_payload = true});
  auto mission = photographing(who);
  mission.items = {mission.items.front(), tests::place(who, "yard", 0, 30),
                   act("drop", io::mavlink::mav_cmd::do_gripper, 1, 0, 0)};
  world.load(mission);
  const auto is_complete = [&] {
    return !world.reports().empty() && world.reports().back().kind == progress_kind::complete;
  };
  ASSERT_TRUE(world.run_until(is_complete, 300)) << world.story();
  const auto* drop = report_of(world, "drop");
  ASSERT_NE(drop, nullptr) << world.story();
  EXPECT_EQ(drop->outcome, act_outcome::confirmed) << world.story();
}

TEST(acts_flight, a_vehicle_without_camera_and_gripper_confirms_nothing) {
  for (const auto who : flyers) {
    flight_world world({.who = who});
    world.load(photographing(who));
    ASSERT_TRUE(world.run_until([&] { return world.durable().status.now == phase::done; }, 900)) << world.story();
    for (const auto* id : {"on", "off", "photo", "drop"}) {
      const auto* report = report_of(world, id);
      ASSERT_NE(report, nullptr) << id << world.story();
      EXPECT_EQ(report->kind, progress_kind::passed);
      EXPECT_FALSE(report->outcome);
      EXPECT_FALSE(report->pictures);
    }
  }
}

// On the line, so that what is counted there is counted over the kills.
TEST(acts_flight, pictures_of_a_line_are_counted_over_kills) {
  for (const auto who : flyers) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      flight_world world({.who = who, .seed = seed, .has_payload = true});
      std::mt19937_64 random(seed);
      ASSERT_TRUE(tests::fly_to(world, photographing(who), progress_kind::started, "line"));
      for (int kills = 0; kills < 3; ++kills) {
        world.run_for(std::uniform_real_distribution<double>(0.2, 3)(random));
        world.crash_all();
      }
      ASSERT_TRUE(world.run_until([&] { return world.durable().status.now == phase::done; }, 900)) << world.story();
      expect_all_acts(world, who, 5);
    }
  }
}

// Three lines of 81 m to the north, 15 m apart, a picture each 10 m.
mission::document surveying(personality who) {
  auto result = tests::short_mission(who);
  result.schema_version = "2.1.0";
  mission::survey area{"field", {}, 12, 15, 0.0, mission::survey_camera{{10.0, std::nullopt}, -90.0, 12}};
  for (const auto& [north, east] : {std::pair{20.0, 0.0}, {101.0, 0.0}, {101.0, 30.0}, {20.0, 30.0}}) {
    const auto at = std::get<mission::waypoint>(tests::place(who, "", north, east)).at;
    area.polygon.push_back({at.latitude, at.longitude});
  }
  result.items = {result.items.front(), area, result.items.back()};
  return result;
}

struct line_pictures {
  std::vector<double> along_m; // from its southern end
};

// By the lines that the plan has; a picture elsewhere is in transit.
std::vector<line_pictures> by_line(const flight_world& world, personality who) {
  const auto origin = std::get<mission::waypoint>(tests::place(who, "", 20, 0)).at;
  std::vector<line_pictures> lines(3);
  for (const auto& each : world.pictures()) {
    const geo::point from{origin.latitude, origin.longitude};
    const geo::point at{each.latitude_deg, each.longitude_deg};
    const double bearing = geo::bearing_deg(from, at) * std::numbers::pi / 180;
    const double north_m = geo::distance_m(from, at) * std::cos(bearing);
    const double east_m = geo::distance_m(from, at) * std::sin(bearing);
    const auto nearest = static_cast<std::size_t>(std::clamp(std::lround(east_m / 15), 0L, 2L));
    EXPECT_LT(std::abs(east_m - 15 * static_cast<double>(nearest)), 2.5) << "in transit";
    EXPECT_TRUE(north_m > -4 && north_m < 85) << "in transit: " << north_m;
    lines[nearest].along_m.push_back(north_m);
  }
  return lines;
}

void expect_no_gap(const flight_world& world, personality who) {
  for (auto& line : by_line(world, who)) {
    std::ranges::sort(line.along_m);
    ASSERT_GE(line.along_m.size(), 8U);
    EXPECT_LT(line.along_m.front(), 4);
    EXPECT_GT(line.along_m.back(), 76);
    for (std::size_t i = 1; i < line.along_m.size(); ++i)
      EXPECT_LT(line.along_m[i] - line.along_m[i - 1], 13) << "at " << line.along_m[i];
  }
}

TEST(acts_flight, a_survey_takes_its_pictures_on_the_lines_alone) {
  for (const auto who : flyers) {
    flight_world world({.who = who, .has_payload = true});
    world.load(surveying(who));
    ASSERT_TRUE(world.run_until([&] { return world.durable().status.now == phase::done; }, 900)) << world.story();
    expect_no_gap(world, who);
    const auto* field = report_of(world, "field");
    ASSERT_NE(field, nullptr) << world.story();
    ASSERT_TRUE(field->pictures) << world.story();
    EXPECT_EQ(field->pictures->planned, 30U) << "with two at the ends of each line";
    EXPECT_EQ(field->pictures->taken, world.pictures().size()) << world.story();
  }
}

void send_away(flight_world& world, personality who, double then_s) {
  operators::command away;
  away.kind = operators::command_kind::go_to;
  away.place = std::get<mission::waypoint>(tests::place(who, "there", 60, 60)).at;
  ASSERT_TRUE(world.say(away).is_taken) << world.story();
  world.run_for(then_s);
}

TEST(acts_flight, an_interrupted_line_goes_on_at_its_last_picture_without_pictures_on_the_way) {
  for (const auto who : flyers) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      flight_world world({.who = who, .seed = seed, .has_payload = true});
      std::mt19937_64 random(seed);
      const auto some = [&](double least, double most) {
        return std::uniform_real_distribution<double>(least, most)(random);
      };
      ASSERT_TRUE(tests::fly_to(world, surveying(who), progress_kind::started, "field"));
      const auto wanted = std::uniform_int_distribution<std::size_t>(2, 12)(random);
      ASSERT_TRUE(world.run_until([&] { return world.pictures().size() >= wanted; }, 120)) << world.story();
      send_away(world, who, some(4, 15));
      world.crash_all();
      world.run_for(some(2, 6));
      ASSERT_TRUE(world.say(operators::command_kind::cancel).is_taken) << world.sentence() << world.story();
      ASSERT_TRUE(world.run_until([&] { return world.durable().status.now == phase::done; }, 900)) << world.story();
      expect_no_gap(world, who);
      EXPECT_LE(world.pictures().size(), 30U + 2U) << "where it was left, and as it goes on";
      const auto* field = report_of(world, "field");
      ASSERT_TRUE(field != nullptr && field->pictures) << world.story();
      EXPECT_EQ(field->pictures->taken, world.pictures().size()) << world.story();
      EXPECT_LE(field->pictures->taken, *field->pictures->planned);
      EXPECT_GE(field->pictures->taken + 4, *field->pictures->planned);
      EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
    }
  }
}

// The same with the items of a ground station, of which the trigger is one.
TEST(acts_flight, an_interrupted_line_of_commands_goes_on_at_its_last_picture) {
  for (const auto who : flyers) {
    for (const std::size_t wanted : {1, 3, 5}) {
      flight_world world({.who = who, .has_payload = true});
      ASSERT_TRUE(tests::fly_to(world, photographing(who, true), progress_kind::started, "line"));
      ASSERT_TRUE(world.run_until([&] { return world.pictures().size() >= wanted; }, 120)) << world.story();
      send_away(world, who, 8);
      ASSERT_TRUE(world.say(operators::command_kind::cancel).is_taken) << world.sentence() << world.story();
      ASSERT_TRUE(world.run_until([&] { return world.durable().status.now == phase::done; }, 900)) << world.story();
      const auto* line = report_of(world, "line");
      ASSERT_TRUE(line != nullptr && line->pictures) << world.story();
      const auto flown_again = wanted == 1 ? 1U : 0U; // from its beginning, and counted anew
      EXPECT_EQ(line->pictures->taken, world.pictures().size() - 1 - flown_again) << world.story();
      EXPECT_LE(line->pictures->taken, 8U + 2U) << world.story();
      std::vector<double> north_m;
      const auto entry = std::get<mission::waypoint>(tests::place(who, "", 30, 0)).at;
      for (const auto& each : world.pictures())
        north_m.push_back(geo::distance_m(geo::point{entry.latitude, entry.longitude},
                                          geo::point{each.latitude_deg, each.longitude_deg}));
      north_m.pop_back(); // the single one
      std::ranges::sort(north_m);
      for (std::size_t i = 1; i < north_m.size(); ++i)
        EXPECT_LT(north_m[i] - north_m[i - 1], 13) << world.story();
    }
  }
}

} // namespace acts_flight_test
} // namespace godwit::executor
