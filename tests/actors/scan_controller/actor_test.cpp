#include "actors/scan_controller/actor.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>

#include "runtime/simulation/simulation.hpp"
#include "tests/actors/scan_controller/scan_world.hpp"
#include "tests/support/run_options.hpp"

namespace scan_controller_actor_test {

using namespace godwit;
using namespace godwit::scan_controller;
using namespace godwit::test;
using namespace std::chrono_literals;
using mapobjects_store::map_failure;
using runtime::crash_point;

// Outside of the actors, where no crash reaches it.
struct heard {
  std::map<std::uint64_t, int> shown; // how often, by number
  std::map<std::uint64_t, point_outcome> closed;
  std::map<std::uint64_t, std::int64_t> closed_ns;
  std::vector<std::int64_t> shown_ns;
  std::map<std::string, mapobjects_store::verdict> verdicts; // in the map, by id
  std::vector<std::string> passes;
  int asks = 0;
  map_failure map = map_failure::none;
  runtime::simulation* world = nullptr;
};

class subscriber final : public runtime::actor_base<subscriber_handle> {
public:
  subscriber(runtime::spawn_context context, heard* log) : actor_base(std::move(context)), log_(log) {}

protected:
  behavior_type handlers() override {
    return {on<point_shown>([this](const point_shown& m) {
              ++log_->shown[m.number];
              log_->shown_ns.push_back(m.shown_ns);
            }),
            on<point_closed>([this](const point_closed& m) {
              EXPECT_TRUE(log_->closed.emplace(m.number, m.outcome).second) << m.number;
              log_->closed_ns[m.number] = now_ns();
            })};
  }

private:
  heard* log_;
};

class map_stand_in final : public runtime::actor_base<map_handle> {
public:
  map_stand_in(runtime::spawn_context context, heard* log) : actor_base(std::move(context)), log_(log) {}

protected:
  behavior_type handlers() override {
    namespace ms = mapobjects_store;
    return {on<ms::operator_verdict>([this](const ms::operator_verdict& m) {
              ++log_->asks;
              if (log_->map == map_failure::none) {
                const auto [there, is_new] = log_->verdicts.emplace(m.id, m.said);
                EXPECT_TRUE(is_new || there->second == m.said) << "one id, two verdicts";
              }
              return ms::verdict_answer{{}, log_->map, {}};
            }),
            on<ms::pass_end>([this](const ms::pass_end& m) {
              log_->passes.push_back(m.id);
              return ms::pass_answer{{}, log_->map, {}};
            })};
  }

private:
  heard* log_;
};

// One that crashes often is not given up.
runtime::child_policy patient() {
  runtime::child_policy result;
  result.restart.intensity = 1'000'000;
  result.restart.backoff_initial = result.restart.backoff_max = 1ms;
  return result;
}

struct process {
  process(runtime::simulated_disk& disk, heard& log, settings configured = {}) : world(disk, 1) {
    auto& actors = world.actors();
    others->say = [](const std::string&, bool) {};
    points = actors.add<actor>({.name = "scan_controller"}, patient(), std::move(configured),
                               std::shared_ptr<const peers>(others), 1);
    others->map = actors.add<map_stand_in>({.name = "map"}, patient(), &log);
    others->subscribers.emplace_back(actors.add<subscriber>({.name = "subscriber"}, patient(), &log));
    world.start();
    world.run_until_idle();
  }
  void see(candidate what) {
    what.at_ns = world.time().wall_ns();
    (void)world.ask(points, 5s, std::move(what));
  }
  void say(std::uint64_t number, decision what) { (void)world.ask(points, 5s, decide_point{number, what, "anna"}); }
  scan_controller::points look() {
    const auto asked = world.ask(points, 1s, get_points{});
    world.run_until_idle();
    EXPECT_EQ(asked->answers, 1);
    return asked->answer;
  }
  std::shared_ptr<peers> others = std::make_shared<peers>();
  runtime::simulation world;
  own_handle points;
};

constexpr std::array crash_points{crash_point::before_handler, crash_point::after_handler, crash_point::after_commit,
                                  crash_point::before_dispatch};

TEST(scan_controller, what_is_seen_is_shown_decided_and_in_the_map) {
  runtime::simulated_disk disk;
  heard log;
  process p(disk, log);
  p.see(thing(1));
  p.see(thing(2));
  p.world.run_until_idle();
  p.say(1, decision::confirm);
  p.say(2, decision::decline);
  p.world.run_until_idle();
  EXPECT_EQ(log.closed,
            (std::map<std::uint64_t, point_outcome>{{1, point_outcome::confirmed}, {2, point_outcome::declined}}));
  EXPECT_EQ(log.verdicts.size(), 2U);
  EXPECT_EQ(p.look().confirmed.size(), 1U);
}

TEST(scan_controller, a_window_ends_within_10_ms_of_its_time) {
  runtime::simulated_disk disk;
  heard log;
  process p(disk, log);
  p.see(thing(1));
  p.world.run_until_idle();
  ASSERT_EQ(log.shown_ns.size(), 1U);
  p.world.advance(61s);
  ASSERT_TRUE(log.closed_ns.contains(1));
  EXPECT_NEAR(static_cast<double>(log.closed_ns[1] - log.shown_ns[0]), 60e9, 10e6);
}

TEST(scan_controller, nothing_is_shown_decided_or_answered_before_the_disk_has_it) {
  runtime::simulated_disk disk;
  heard log;
  process p(disk, log);
  p.world.journal().fail_writes(true);
  p.see(thing(1));
  const auto asked = p.world.ask(p.points, 50s, get_points{});
  p.world.run_until_idle();
  EXPECT_TRUE(log.shown.empty());
  EXPECT_EQ(asked->answers, 0);
  p.world.journal().fail_writes(false);
  p.world.advance(1s);
  EXPECT_EQ(log.shown.size(), 1U);
  EXPECT_EQ(asked->answers, 1);
  p.world.journal().fail_writes(true);
  p.say(1, decision::decline);
  p.world.run_until_idle();
  EXPECT_EQ(log.asks, 0) << "the map hears nothing that a crash could take back";
}

TEST(scan_controller, a_crash_at_any_point_neither_loses_nor_doubles_a_point_or_a_decision) {
  for (const auto point : crash_points)
    for (const bool in_decision : {false, true}) {
      SCOPED_TRACE(std::to_string(static_cast<int>(point)) + (in_decision ? ", decision" : ", candidate"));
      runtime::simulated_disk disk;
      heard log;
      process p(disk, log);
      if (!in_decision)
        p.world.crash_at("scan_controller", point);
      p.see(thing(1));
      p.world.advance(1s);
      p.see(thing(1)); // who has heard no answer
      p.world.advance(1s);
      if (in_decision)
        p.world.crash_at("scan_controller", point);
      p.say(1, decision::decline);
      p.world.advance(1s);
      p.say(1, decision::decline);
      p.world.advance(30s);
      EXPECT_EQ(p.world.counters("scan_controller").crashes, 1U);
      EXPECT_EQ(log.shown, (std::map<std::uint64_t, int>{{1, 1}}));
      EXPECT_EQ(log.closed, (std::map<std::uint64_t, point_outcome>{{1, point_outcome::declined}}));
      EXPECT_EQ(log.verdicts.size(), 1U);
    }
}

TEST(scan_controller, a_map_that_does_not_take_a_decision_is_asked_until_it_does) {
  runtime::simulated_disk disk;
  heard log;
  log.map = map_failure::busy;
  process p(disk, log);
  p.see(thing(1));
  p.world.run_until_idle();
  p.say(1, decision::decline);
  p.world.advance(7s);
  EXPECT_EQ(log.asks, 4) << "at once and every two seconds";
  EXPECT_TRUE(log.verdicts.empty());
  log.map = map_failure::none;
  p.world.advance(3s);
  EXPECT_EQ(log.verdicts.size(), 1U);
  const int asks = log.asks;
  p.world.advance(60s);
  EXPECT_EQ(log.asks, asks);
}

TEST(scan_controller, what_the_map_refuses_it_is_not_asked_again) {
  runtime::simulated_disk disk;
  heard log;
  log.map = map_failure::refused;
  process p(disk, log);
  p.see(thing(1));
  p.world.run_until_idle();
  p.say(1, decision::decline);
  p.world.advance(60s);
  EXPECT_EQ(log.asks, 1);
}

TEST(scan_controller, a_killed_process_knows_its_points_its_decisions_and_the_rate) {
  runtime::simulated_disk disk;
  heard log;
  log.map = map_failure::busy;
  {
    process p(disk, log);
    for (int i = 1; i <= 7; ++i)
      p.see(thing(i));
    p.world.run_until_idle();
    p.say(1, decision::decline);
    p.world.advance(100ms);
  } // killed
  log.map = map_failure::none;
  process again(disk, log); // on a computer that was started again: its clock begins anew
  again.world.advance(3s);
  EXPECT_EQ(log.verdicts.size(), 1U) << "the decision is delivered now";
  const auto seen = again.look();
  EXPECT_EQ(seen.shown.size(), 4U);
  EXPECT_EQ(seen.waiting, 2U) << "five were shown within this minute";
  again.world.advance(60s);
  EXPECT_EQ(log.shown.size(), 7U);
  for (const auto& [number, times] : log.shown)
    EXPECT_EQ(times, 1) << number;
}

TEST(scan_controller, a_whole_pass_is_told_to_the_map_once_when_sightings_have_settled) {
  runtime::simulated_disk disk;
  heard log;
  process p(disk, log, {.looks_for = {"vehicle"}});
  survey_progress at{scan_mission, "field", 1, true, true, 2, 0, {{47, 8}, {47, 8.01}, {47.01, 8}}};
  const auto fly = [&](bool is_at_beginning, std::uint32_t lines_done) {
    at.is_at_beginning = is_at_beginning;
    at.lines_done = lines_done;
    p.world.tell(p.points, at);
    p.world.advance(1s);
  };
  fly(true, 0);
  fly(false, 0);
  fly(false, 1);
  p.world.kill("scan_controller"); // it knows what it has seen
  p.world.advance(100ms);
  fly(false, 2);
  EXPECT_TRUE(log.passes.empty());
  p.world.advance(10s);
  EXPECT_EQ(log.passes.size(), 1U);
  p.world.advance(60s);
  EXPECT_EQ(log.passes.size(), 1U);
}

// Kills, crashes at each point and lost processes, over arrivals and decisions at random.
TEST(scan_controller_property, whatever_crashes_five_in_a_minute_each_point_once_and_no_decision_is_lost) {
  const std::uint64_t seeds = tests::is_full_run() ? 100 : 5;
  for (std::uint64_t seed = 1; seed <= seeds && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng(seed);
    runtime::simulated_disk disk;
    heard log;
    process p(disk, log);
    const auto draw = [&](std::uint64_t below) { return rng() % below; };
    for (int i = 0; i < 400; ++i) {
      const auto number = static_cast<std::uint64_t>(log.shown.empty() ? 1 : log.shown.rbegin()->first);
      p.world.forget_planned_crashes();
      if (draw(3) == 0)
        p.world.crash_at("scan_controller", crash_points.at(draw(crash_points.size())));
      if (draw(20) == 0)
        (void)p.world.kill("scan_controller");
      log.map = draw(4) == 0 ? map_failure::busy : map_failure::none;
      p.see(thing(static_cast<int>(draw(60)), 0.01 * static_cast<double>(draw(101))));
      if (draw(2) == 0)
        p.say(number - std::min<std::uint64_t>(draw(3), number - 1),
              draw(2) == 0 ? decision::confirm : decision::decline);
      for (std::uint64_t steps = draw(20); steps > 0 && p.world.step(rng()); --steps) {
      }
      p.world.advance(std::chrono::milliseconds(draw(5'000)));
    }
    p.world.forget_planned_crashes();
    log.map = map_failure::none;
    p.world.advance(700s);
    for (const auto& [point, times] : log.shown)
      EXPECT_EQ(times, 1) << point;
    std::ranges::sort(log.shown_ns);
    for (std::size_t i = 5; i < log.shown_ns.size(); ++i)
      EXPECT_GT(log.shown_ns[i] - log.shown_ns[i - 5], rate_window_ns);
    const auto c = p.look().counts;
    EXPECT_EQ(c.confirmed + c.declined + c.passed_over, log.shown.size());
    EXPECT_EQ(log.closed.size(), log.shown.size());
    EXPECT_EQ(log.verdicts.size(), c.confirmed + c.declined);
    EXPECT_EQ(c.opened, log.shown.size() + c.too_faint + c.too_old + c.no_room);
  }
}

} // namespace scan_controller_actor_test
