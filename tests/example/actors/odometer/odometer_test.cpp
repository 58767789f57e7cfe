#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <array>
#include <map>
#include <memory>
#include <string>

#include "runtime/actor_base.hpp"
#include "runtime/simulation/simulation.hpp"
#include "runtime/stored_state.hpp"
#include "tests/example/actors/odometer/actor.hpp"

namespace odometer_test {

using namespace godwit;
using namespace godwit::odometer;
using namespace std::chrono_literals;
using runtime::crash_point;

// -- the core: a function, tested as one -----------------------------------------------------------------------------

TEST(odometer_core, each_full_kilometre_is_one_milestone) {
  state s;
  EXPECT_TRUE(core::apply(s, moved{999}, 1).empty());
  const auto effects = core::apply(s, moved{2001}, 7);
  ASSERT_EQ(effects.size(), 3U);
  EXPECT_EQ(std::get<milestone>(effects[2]).kilometre, 3U);
  EXPECT_EQ(std::get<milestone>(effects[2]).at_ns, 7);
}

TEST(odometer_core, a_reset_asked_for_again_takes_nothing_away) {
  state s{500, {}};
  const auto first = core::apply(s, reset{42}, 1);
  (void)core::apply(s, moved{300}, 2);
  const auto again = core::apply(s, reset{42}, 3);
  EXPECT_EQ(std::get<reset_done>(first.at(0)).distance_m, 500U);
  EXPECT_EQ(std::get<reset_done>(again.at(0)).distance_m, 500U);
  EXPECT_EQ(s.total_m, 300U);
}

TEST(odometer_core, a_snapshot_of_version_1_is_read) {
  const auto s = runtime::read_state<core>("odometer", {7, 0, 1, R"({"total_m":1234})"});
  EXPECT_EQ(s.total_m, 1234U);
  EXPECT_FALSE(s.last_reset);
}

// -- the actor, in a simulated process -------------------------------------------------------------------------------

using milestones = std::map<std::uint64_t, int>; // kilometre -> how often it was told

// Writes into the test's own memory, which no crash takes back.
class listener final : public runtime::actor_base<listener_handle> {
public:
  listener(runtime::spawn_context context, milestones* heard) : actor_base(std::move(context)), heard_(heard) {}

protected:
  behavior_type handlers() override {
    return {on<milestone>([this](const milestone& m) { ++(*heard_)[m.kilometre]; })};
  }

private:
  milestones* heard_;
};

// Restarts again and again: the test is about what is kept, not about giving up.
runtime::child_policy patient() {
  runtime::child_policy result;
  result.restart = {.intensity = 100'000, .backoff_initial = 10ms, .backoff_max = 100ms};
  return result;
}

// One process over a disk that outlives it. Destroying it is SIGKILL.
struct process {
  process(runtime::simulated_disk& disk, milestones& heard) : world(disk, 1) {
    const auto ears = world.actors().add<listener>({.name = "listener"}, patient(), &heard);
    odometer = world.actors().add<actor>({.name = "odometer"}, patient(), ears);
    world.start();
    world.run_until_idle();
  }
  std::uint64_t total_m() {
    const auto asked = world.ask(odometer, 1s, get_total{});
    world.run_until_idle();
    return asked->answer.distance_m;
  }
  runtime::simulation world;
  handle odometer;
};

constexpr std::array points{crash_point::before_handler, crash_point::after_handler, crash_point::after_commit,
                            crash_point::before_dispatch};

TEST(odometer, a_crash_at_any_point_neither_loses_nor_doubles_a_milestone) {
  for (const auto point : points) {
    runtime::simulated_disk disk;
    milestones heard;
    process p(disk, heard);
    p.world.crash_at("odometer", point);
    p.world.tell(p.odometer, moved{600});
    p.world.tell(p.odometer, moved{600});
    p.world.advance(1s);
    EXPECT_EQ(p.world.counters("odometer").crashes, 1U) << static_cast<int>(point);
    EXPECT_EQ(p.total_m(), 1200U) << static_cast<int>(point);
    EXPECT_EQ(heard, (milestones{{1, 1}})) << static_cast<int>(point);
  }
}

TEST(odometer, a_reset_is_answered_once_whenever_the_odometer_crashes) {
  for (const auto point : points) {
    runtime::simulated_disk disk;
    milestones heard;
    process p(disk, heard);
    p.world.tell(p.odometer, moved{700});
    p.world.run_until_idle();
    p.world.crash_at("odometer", point);
    const auto asked = p.world.ask(p.odometer, 10s, reset{1});
    p.world.advance(1s);
    EXPECT_EQ(asked->answers, 1) << static_cast<int>(point);
    EXPECT_EQ(asked->answer.distance_m, 700U) << static_cast<int>(point);
    EXPECT_EQ(p.total_m(), 0U) << static_cast<int>(point);
  }
}

TEST(odometer, no_answer_and_no_milestone_before_the_disk_has_it) {
  runtime::simulated_disk disk;
  milestones heard;
  process p(disk, heard);
  p.world.journal().fail_writes(true);
  p.world.tell(p.odometer, moved{1000});
  const auto asked = p.world.ask(p.odometer, 10s, reset{1});
  p.world.run_until_idle();
  EXPECT_TRUE(heard.empty());
  EXPECT_EQ(asked->answers, 0);
  p.world.journal().fail_writes(false);
  p.world.run_until_idle();
  EXPECT_EQ(heard, (milestones{{1, 1}}));
  EXPECT_EQ(asked->answers, 1);
}

TEST(odometer, a_killed_process_starts_again_with_its_total_and_owes_the_milestones) {
  runtime::simulated_disk disk;
  milestones heard;
  {
    process p(disk, heard);
    p.world.crash_at("odometer", crash_point::before_dispatch); // on the disk, and not let out
    p.world.tell(p.odometer, moved{2500});
    while (p.world.counters("odometer").crashes == 0 && p.world.step(1)) {
    }
  } // killed
  EXPECT_TRUE(heard.empty());
  process again(disk, heard);
  EXPECT_EQ(again.total_m(), 2500U);
  EXPECT_EQ(heard, (milestones{{1, 1}, {2, 1}}));
}

// -- any order of moves, steps, kills and crashes --------------------------------------------------------------------

RC_GTEST_PROP(odometer_property, every_full_kilometre_is_told_exactly_once, ()) {
  enum kind { move, step, kill, crash, kinds };
  const auto ops = *rc::gen::container<std::vector<std::pair<int, int>>>(
      rc::gen::pair(rc::gen::inRange<int>(0, kinds), rc::gen::inRange<int>(0, 3000)));
  runtime::simulated_disk disk;
  milestones heard;
  process p(disk, heard);
  std::uint64_t sent_m = 0;
  for (const auto& [what, number] : ops) {
    switch (what) {
    case move:
      sent_m += static_cast<std::uint64_t>(number);
      p.world.tell(p.odometer, moved{static_cast<std::uint16_t>(number)});
      break;
    case step:
      p.world.step(static_cast<std::uint64_t>(number));
      break;
    case kill:
      p.world.kill("odometer");
      break;
    case crash: // one at a time: a message that crashes its handler three times becomes a dead letter
      p.world.forget_planned_crashes();
      p.world.crash_at("odometer", points.at(static_cast<std::size_t>(number) % points.size()));
      break;
    }
  }
  p.world.forget_planned_crashes();
  p.world.advance(2s);
  for (const auto& each : disk.dead_letters)
    sent_m -= nlohmann::json::parse(each.body).at("distance_m").get<std::uint64_t>();
  RC_ASSERT(p.total_m() == sent_m);
  RC_ASSERT(heard.size() == sent_m / core::milestone_m);
  for (const auto& [kilometre, times] : heard)
    RC_ASSERT(times == 1 && kilometre <= heard.size());
}

} // namespace odometer_test
