// The broker in whole flights, with all vices: what happens reaches it once in effect and in order, and nothing that it
// does touches the flight.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"

namespace broker_flight_test {

using namespace godwit;
using namespace godwit::drill;
using executor::phase;
using json = nlohmann::json;

class broker_flight : public testing::Test {
protected:
  broker_flight() {
    fleet_link::settings fleet;
    fleet.broker = io::mqtt::parse_broker_uri("mqtts://fleet.example.org").value();
    fleet.vehicle = "rover-7";
    flight.outside().settings.fleet = fleet;
  }

  broker_world& broker() { return flight.outside().broker; }
  std::string status() {
    const auto found = broker().kept.find("gw/v1/rover-7/status");
    return found == broker().kept.end() ? "" : json::parse(found->second).at("state").get<std::string>();
  }
  // Without repetitions. Adds a failure when one is missing, out of order, or an id means two things.
  std::vector<json> events() {
    std::vector<json> result;
    std::map<std::uint64_t, std::string> known;
    for (const auto& each : broker().events) {
      auto event = json::parse(each);
      const auto [first, is_new] = known.emplace(event.at("number").get<std::uint64_t>(), each);
      EXPECT_EQ(first->second, each);
      if (!is_new)
        continue;
      EXPECT_EQ(first->first, result.size() + 1);
      result.push_back(std::move(event));
    }
    return result;
  }
  std::vector<std::string> phases() {
    std::vector<std::string> result;
    for (const auto& each : events())
      if (each.at("kind") == "flight" && (result.empty() || result.back() != each.at("data").at("phase")))
        result.push_back(each.at("data").at("phase"));
    return result;
  }
  bool has(const std::string& kind) {
    const auto all = events();
    return std::ranges::any_of(all, [&](const json& each) { return each.at("kind") == kind; });
  }
  void land() {
    EXPECT_TRUE(flight.run_until_phase(phase::done, 900)) << flight.story();
    EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
  }
  // What waits is told.
  void drain() {
    EXPECT_TRUE(flight.run_until(
        [&] {
          const auto now = flight.process()->report();
          return now && now->fleet && now->fleet->is_connected && now->fleet->waiting == 0;
        },
        120))
        << flight.story();
  }

  flight_simulation flight{{.speed = 2, .is_shuffled = false}};
};

TEST_F(broker_flight, who_watches_sees_the_flight_from_its_beginning_to_its_end) {
  land();
  drain();
  const auto seen = phases();
  for (const auto* each : {"ready", "flying", "done"})
    EXPECT_NE(std::ranges::find(seen, each), seen.end()) << each;
  EXPECT_TRUE(has("authority"));
  EXPECT_TRUE(has("progress"));
  EXPECT_TRUE(has("failsafe"));
  EXPECT_EQ(status(), "online");
  flight.run_for(3);
  EXPECT_EQ(json::parse(broker().kept.at("gw/v1/rover-7/state/flight")).at("data").at("phase"), "done");
  EXPECT_GT(broker().live, 60U);
}

TEST_F(broker_flight, a_broker_that_is_lost_a_hundred_times_gets_each_event_and_the_flight_goes_on) {
  double slowest_s = 0;
  for (int i = 0; i < 100; ++i) {
    flight.run_for(11);
    broker().is_away = true;
    flight.run_for(1.5);
    broker().is_away = false;
    const auto back_ns = flight.now_ns();
    const auto before = broker().connects;
    ASSERT_TRUE(flight.run_until([&] { return broker().connects > before; }, 60));
    slowest_s = std::max(slowest_s, static_cast<double>(flight.now_ns() - back_ns) / 1e9);
  }
  land();
  drain();
  EXPECT_EQ(phases().back(), "done");
  RecordProperty("slowest_s", std::to_string(slowest_s));
  EXPECT_LE(slowest_s, 5) << "of the connections that were made again";
}

TEST_F(broker_flight, without_a_broker_the_flight_is_flown_and_told_when_it_is_back) {
  broker().refuses = true;
  ASSERT_TRUE(flight.run_until_phase(phase::flying, 120)) << flight.story();
  EXPECT_EQ(flight.process()->health("fleet_link"), runtime::health_colour::yellow);
  EXPECT_TRUE(flight.was_told("telemetry.username")) << flight.story();
  broker().refuses = false;
  broker().is_away = true;
  land();
  EXPECT_TRUE(broker().events.empty());
  broker().is_away = false;
  drain();
  EXPECT_EQ(phases().back(), "done");
  EXPECT_EQ(events().front().at("historical"), true);
  EXPECT_EQ(flight.process()->health("fleet_link"), runtime::health_colour::green);
}

TEST_F(broker_flight, a_broker_that_takes_nothing_any_more_costs_nothing_but_what_is_live) {
  ASSERT_TRUE(flight.run_until_phase(phase::flying, 120)) << flight.story();
  broker().is_deaf = true;
  land();
  broker().is_deaf = false;
  drain();
  EXPECT_EQ(phases().back(), "done");
}

TEST_F(broker_flight, a_process_that_is_killed_is_said_to_be_gone_and_the_next_one_tells_the_rest) {
  ASSERT_TRUE(flight.run_until_phase(phase::flying, 120)) << flight.story();
  flight.run_for(5);
  broker().is_away = true;
  flight.run_for(10);
  flight.kill_process();
  EXPECT_EQ(status(), "offline");
  flight.run_for(5);
  broker().is_away = false;
  land();
  drain();
  EXPECT_EQ(status(), "online");
  EXPECT_EQ(phases().back(), "done");
  const auto all = events();
  EXPECT_EQ(std::ranges::count_if(all, [](const json& each) { return each.at("kind") == "process_began"; }), 2);
}

TEST_F(broker_flight, an_actor_that_crashes_again_and_again_loses_nothing_and_others_that_do_are_told_of) {
  ASSERT_TRUE(flight.run_until_phase(phase::ready, 120)) << flight.story();
  using runtime::crash_point;
  for (const auto point : {crash_point::before_handler, crash_point::after_handler, crash_point::after_commit,
                           crash_point::before_dispatch}) {
    flight.process()->crash_at("fleet_link", point);
    flight.run_for(4);
  }
  ASSERT_TRUE(flight.process()->kill("mission_client"));
  flight.run_for(10);
  land();
  drain();
  EXPECT_TRUE(has("actor_restarted"));
  EXPECT_EQ(phases().back(), "done");
}

TEST_F(broker_flight, an_actor_that_is_given_up_before_the_flight_or_in_it_takes_nothing_with_it) {
  ASSERT_TRUE(flight.give_up("fleet_link"));
  ASSERT_TRUE(flight.run_until_phase(phase::flying, 120)) << flight.story();
  ASSERT_TRUE(flight.give_up("fleet_link"));
  EXPECT_EQ(status(), "offline");
  land();
}

TEST_F(broker_flight, an_actor_that_hangs_takes_nothing_with_it) {
  ASSERT_TRUE(flight.run_until_phase(phase::flying, 120)) << flight.story();
  flight.process()->hang("fleet_link");
  land();
}

} // namespace broker_flight_test
