// Whole flights with a loop of three rounds that somebody interrupts: go-to, kills, other items after it. The rounds
// that are flown are the rounds that the mission asks for, and each is reported once.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "actors/domain/geo/geodesic.hpp"
#include "tests/actors/executor/flight_checks.hpp"
#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor {
namespace loop_flight_test {

using mission::progress_kind;
using sim::personality;
using tests::flight_world;
using tests::fly_to;

constexpr personality vehicles[] = {personality::px4, personality::ardupilot, personality::ardurover};

// [take-off], w1, w2, w3, twice back to w1, and the end.
mission::document looping(personality who) {
  auto result = tests::short_mission(who);
  result.schema_version = mission::schema_version_2;
  const auto after_w3 = result.items.begin() + (sim::drives(who) ? 3 : 4);
  result.items.insert(after_w3, mission::jump{"again", "w1", 2});
  if (sim::drives(who))
    result.items.push_back(tests::place(who, "end", -20, 20));
  return result;
}

// How often the vehicle comes to a place of the mission: within 4 m, and away from it by 12 m in between.
class visits {
public:
  visits(flight_world& world, const mission::document& mission, const std::string& id) : world_(world) {
    for (const auto& each : mission.items)
      if (mission::id_of(each) == id)
        place_ = std::get<mission::waypoint>(each).at;
  }
  void look() {
    const auto at = world_.vehicle().describe().where;
    const double away_m =
        geo::distance_m(geo::point{at.latitude_deg, at.longitude_deg}, geo::point{place_.latitude, place_.longitude});
    if (!is_there_ && away_m < 4)
      ++count_;
    is_there_ = is_there_ ? away_m < 12 : away_m < 4;
  }
  [[nodiscard]] int count() const { return count_; }

private:
  flight_world& world_;
  mission::position place_;
  bool is_there_ = false;
  int count_ = 0;
};

int told(const flight_world& world, progress_kind kind, const std::string& id) {
  return static_cast<int>(std::ranges::count_if(
      world.reports(), [&](const auto& each) { return each.kind == kind && each.item_id == id; }));
}

operators::command go_to_beside(personality who) {
  operators::command result;
  result.kind = operators::command_kind::go_to;
  result.place = std::get<mission::waypoint>(tests::place(who, "there", 45, 45)).at;
  return result;
}

bool is_done(flight_world& world) { return world.durable().status.now == phase::done; }

TEST(loop_flight, a_rest_that_begins_within_a_loop_has_the_rounds_that_are_left) {
  for (const auto who : vehicles) {
    for (const int round : {1, 2, 3}) {
      flight_world world({.who = who});
      const auto mission = looping(who);
      visits w2(world, mission, "w2");
      const auto until = [&](const auto& condition, double seconds) {
        return world.run_until(
            [&] {
              w2.look();
              return condition();
            },
            seconds);
      };
      world.load(mission);
      ASSERT_TRUE(until([&] { return told(world, progress_kind::reached, "w2") == round; }, 900)) << world.story();
      ASSERT_TRUE(world.say(go_to_beside(who)).is_taken) << world.sentence() << world.story();
      ASSERT_FALSE(until([&] { return is_done(world); }, 15)) << world.story();
      ASSERT_TRUE(world.say(operators::command_kind::cancel).is_taken) << world.sentence() << world.story();
      ASSERT_TRUE(until([&] { return is_done(world); }, 1500)) << io::name_of(who) << ' ' << round << world.story();
      EXPECT_EQ(w2.count(), 3) << io::name_of(who) << ' ' << round << world.story();
      for (const auto* id : {"w1", "w2", "w3"})
        EXPECT_EQ(told(world, progress_kind::reached, id), 3)
            << io::name_of(who) << ' ' << round << ' ' << id << world.story();
      EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
    }
  }
}

mission::assignment other_end(personality who, std::int32_t base) {
  mission::assignment result;
  result.assignment_id = "11111111-2222-4333-8444-10000000000" + std::to_string(base);
  result.base_revision = base;
  result.revision = base + 1;
  result.replace_after_item_id = "again";
  result.items = {tests::place(who, "end" + std::to_string(base), -20, 10.0 * base)};
  return result;
}

TEST(loop_flight, five_kills_and_two_reassignments_change_no_round) {
  for (const auto who : vehicles) {
    for (std::uint64_t seed = 1; seed <= 7; ++seed) { // 8: docs/roadmap.md
      flight_world world({.who = who, .seed = seed});
      const auto mission = looping(who);
      visits w2(world, mission, "w2");
      std::mt19937_64 random(seed);
      const auto fly = [&](double seconds) {
        return world.run_until(
            [&] {
              w2.look();
              return is_done(world);
            },
            seconds);
      };
      const auto some = [&](double most) { return std::uniform_real_distribution<double>(0.1, most)(random); };
      world.load(mission);
      ASSERT_TRUE(world.run_until_phase(phase::flying, 60)) << world.story();
      for (int i = 0; i < 7; ++i) {
        if (fly(some(5)) || told(world, progress_kind::reached, "w3") == 3)
          break;
        if (i == 2 || i == 5)
          world.assign(other_end(who, i == 2 ? 1 : 2));
        else
          world.crash_all();
      }
      if (!fly(12) && world.durable().status.now == phase::paused) // killed while it was held for a plan
        (void)world.say(operators::command_kind::resume);
      ASSERT_TRUE(fly(1500)) << io::name_of(who) << " seed " << seed << world.story();
      EXPECT_EQ(w2.count(), 3) << io::name_of(who) << " seed " << seed << world.story();
      for (const auto* id : {"w1", "w2", "w3"})
        EXPECT_EQ(told(world, progress_kind::reached, id), 3)
            << io::name_of(who) << " seed " << seed << ' ' << id << world.story();
    }
  }
}

TEST(loop_flight, after_a_silence_as_long_as_a_round_the_rest_is_refused_with_the_item_to_start_again_from) {
  flight_world world({.who = personality::px4});
  ASSERT_TRUE(fly_to(world, looping(personality::px4), progress_kind::started, "w3"));
  world.silence_vehicle(true);
  world.run_for(8);
  world.silence_vehicle(false);
  world.run_for(2);
  ASSERT_TRUE(world.say(go_to_beside(personality::px4)).is_taken) << world.story();
  world.run_for(20);
  EXPECT_EQ(world.say(operators::command_kind::cancel).reason,
            "Item 'again': It leads to item 'w1', and how many rounds are left is not known; start the mission again "
            "from item 'w1', or take the jump out.");
  world.run_for(5);
  EXPECT_EQ(world.vehicle().mission_items().size(), 1U) << "it waits where it was sent to\n" << world.story();
}

} // namespace loop_flight_test
} // namespace godwit::executor
