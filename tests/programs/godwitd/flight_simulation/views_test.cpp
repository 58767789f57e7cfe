// What the composition of the daemon shows of itself, and that no flight depends on it.
#include <algorithm>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "actors/health/report_text.hpp"
#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "programs/godwit-drill/flight_simulation/short_mission.hpp"

namespace views_test {

using namespace godwit;
using namespace godwit::drill;
using executor::phase;

class views : public testing::Test {
protected:
  flight_simulation flight{{.who = sim::personality::px4, .speed = 2, .is_shuffled = false}};

  std::shared_ptr<const health::report> report() {
    const auto made = flight.process()->report();
    EXPECT_NE(made, nullptr) << flight.story();
    return made;
  }
};

TEST_F(views, a_report_has_the_word_of_each_part_of_a_flight) {
  ASSERT_TRUE(flight.run_until_phase(phase::flying, 120)) << flight.story();
  flight.run_for(10); // it is off the ground
  const auto now = report();
  ASSERT_TRUE(now && now->flight && now->failsafe && now->vehicle && now->ground && now->service && now->map);
  EXPECT_TRUE(now->unanswered.empty());
  EXPECT_EQ(now->flight->phase, "flying");
  EXPECT_EQ(now->flight->authority, "godwit");
  EXPECT_TRUE(now->failsafe->in_flight);
  EXPECT_TRUE(now->vehicle->connected);
  std::set<std::string> names;
  for (const auto& each : now->actors) {
    const bool is_wanted = each.name != "scan_controller"; // this mission has no survey
    EXPECT_EQ(each.phase == runtime::child_phase::running, is_wanted) << each.name;
    names.insert(each.name);
  }
  for (const auto* each : {"executor", "vehicle_link", "failsafe", "ground_port", "mission_client", "mapobjects_store",
                           "landing_watch", "health"})
    EXPECT_TRUE(names.contains(each)) << each;
  EXPECT_NE(health::json_of(*now).find("\"authority\":\"godwit\""), std::string::npos);
}

TEST_F(views, before_and_after_a_flight_nobody_has_the_vehicle) {
  flight.run_for(2);
  EXPECT_EQ(report()->flight->authority, "nobody");
  ASSERT_TRUE(flight.run_until_phase(phase::done)) << flight.story();
  EXPECT_EQ(report()->flight->authority, "nobody");
}

TEST_F(views, a_part_that_does_not_answer_is_named_and_holds_up_the_report_for_two_seconds) {
  ASSERT_TRUE(flight.run_until_phase(phase::flying, 120)) << flight.story();
  flight.process()->hang("mapobjects_store");
  EXPECT_EQ(flight.process()->report(), nullptr) << "it is waited for";
  flight.run_for(2.1);
  const auto now = flight.process()->newest_report();
  ASSERT_TRUE(now);
  EXPECT_FALSE(now->map);
  ASSERT_EQ(now->unanswered.size(), 1U);
  EXPECT_EQ(now->unanswered.front().part, "map");
  EXPECT_TRUE(now->flight);
}

TEST_F(views, health_is_looked_at_each_second_and_the_worst_counts) {
  flight.run_for(5);
  const auto before = flight.process()->newest_health();
  flight.run_for(2);
  EXPECT_GT(flight.process()->newest_health().at_ns, before.at_ns);
  flight.process()->fail_journal(true);
  flight.process()->hang("mapobjects_store");
  flight.run_for(30);
  const auto& now = flight.process()->newest_health().status;
  EXPECT_NE(now.worst, health::colour::green);
  ASSERT_FALSE(now.parts.empty());
  EXPECT_EQ(now.parts.front().health, now.worst);
}

TEST_F(views, a_health_actor_that_crashes_hangs_or_is_given_up_does_not_touch_the_flight) {
  ASSERT_TRUE(flight.run_until_phase(phase::flying, 120)) << flight.story();
  for (const auto point : {runtime::crash_point::before_handler, runtime::crash_point::after_handler}) {
    flight.process()->crash_at("health", point);
    flight.run_for(3);
  }
  ASSERT_TRUE(flight.give_up("health")) << flight.story();
  ASSERT_TRUE(flight.run_until_phase(phase::done)) << flight.story();
  EXPECT_EQ(flight.processes(), 1) << flight.story();
}

// What a subscriber hears of a topic, as it stands at the end.
std::vector<nlohmann::json> said_about(telemetry_stream::subscriber& who, std::string_view topic) {
  std::vector<nlohmann::json> result;
  while (const auto text = who.take())
    if (auto said = nlohmann::json::parse(*text); said.at("topic") == topic)
      result.push_back(said.at("data"));
  return result;
}

TEST_F(views, a_subscriber_sees_the_flight_and_who_has_the_vehicle_from_its_beginning_to_its_end) {
  flight.run_for(1);
  using telemetry_stream::topic;
  const telemetry_stream::queue_bounds endless{1'000'000, 1'000'000'000, 1'000'000, 1'000'000'000};
  const auto phases = flight.process()
                          ->stream()
                          .subscribe(
                              {{topic::flight, 0}}, [] {}, endless)
                          .value();
  const auto holders = flight.process()
                           ->stream()
                           .subscribe(
                               {{topic::authority, 0}}, [] {}, endless)
                           .value();
  const auto places = flight.process()
                          ->stream()
                          .subscribe(
                              {{topic::position, 0}}, [] {}, endless)
                          .value();
  const auto done = flight.process()
                        ->stream()
                        .subscribe(
                            {{topic::progress, 0}}, [] {}, endless)
                        .value();
  ASSERT_TRUE(flight.run_until_phase(phase::done)) << flight.story();
  std::set<std::string> seen;
  for (const auto& each : said_about(*phases, "flight"))
    seen.insert(each.at("phase"));
  for (const auto* each : {"preflight", "uploading", "ready", "starting", "flying", "done"})
    EXPECT_TRUE(seen.contains(each)) << each;
  std::vector<std::string> had;
  for (const auto& each : said_about(*holders, "authority"))
    had.push_back(each.at("holder"));
  EXPECT_EQ(had.front(), "nobody");
  EXPECT_NE(std::ranges::find(had, "godwit"), had.end());
  EXPECT_EQ(had.back(), "nobody");
  EXPECT_GT(said_about(*places, "position").size(), 100U);
  const auto progress = said_about(*done, "progress");
  EXPECT_EQ(progress.back().at("items_done"), progress.back().at("items"));
}

TEST_F(views, missions_and_what_the_way_home_needs_are_in_the_stream_and_in_the_report) {
  flight.run_for(1);
  using telemetry_stream::topic;
  const telemetry_stream::queue_bounds endless{1'000'000, 1'000'000'000, 1'000'000, 1'000'000'000};
  const auto heard = flight.process()
                         ->stream()
                         .subscribe(
                             {{topic::missions, 0}}, [] {}, endless)
                         .value();
  const auto ways = flight.process()
                        ->stream()
                        .subscribe(
                            {{topic::way_home, 0}}, [] {}, endless)
                        .value();
  ASSERT_TRUE(flight.run_until_phase(phase::flying, 120)) << flight.story();
  flight.run_for(5);
  ASSERT_TRUE(report()->missions);
  ASSERT_FALSE(report()->missions->list.empty());
  EXPECT_EQ(report()->missions->list.front().place, executor::mission_place::in_flight);
  ASSERT_TRUE(flight.run_until_phase(phase::done)) << flight.story();
  flight.run_for(1); // it is shown with the next tick
  std::set<std::string> places;
  for (const auto& each : said_about(*heard, "missions"))
    if (!each.at("list").empty())
      places.insert(each.at("list").at(0).at("place"));
  EXPECT_EQ(places, (std::set<std::string>{"prepared", "in_flight", "ended"}));
  const auto told = said_about(*ways, "way_home");
  EXPECT_GT(told.size(), 10U);
  for (const auto& each : told)
    EXPECT_EQ(each.at("needs_percent").is_null(), !each.at("why_not_known").get<std::string>().empty()) << each;
}

std::size_t times_in(const std::string& text, std::string_view words) {
  std::size_t result = 0;
  for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + 1))
    ++result;
  return result;
}

std::vector<std::uint16_t> commands_of(const flight_simulation& flight) {
  std::vector<std::uint16_t> result;
  for (const auto& each : flight.orders())
    result.push_back(each.command);
  return result;
}

TEST(views_of_traffic, other_aircraft_are_shown_and_told_of_once_and_the_mission_is_flown_as_without_them) {
  using telemetry_stream::topic;
  flight_simulation alone{{.who = sim::personality::px4, .speed = 1, .is_shuffled = false}};
  ASSERT_TRUE(alone.run_until_phase(phase::done)) << alone.story();
  flight_simulation flight{{.who = sim::personality::px4, .speed = 1, .aircraft = 3, .is_shuffled = false}};
  flight.run_for(1);
  const auto shown = flight.process()
                         ->stream()
                         .subscribe({{topic::traffic, 0}}, [] {}, {1'000'000, 1'000'000'000, 1'000'000, 1'000'000'000})
                         .value();
  ASSERT_TRUE(flight.run_until_phase(phase::flying, 120)) << flight.story();
  const auto made = flight.process()->report();
  ASSERT_TRUE(made && made->traffic);
  EXPECT_EQ(made->traffic->aircraft.size(), 3U);
  ASSERT_TRUE(flight.run_until_phase(phase::done)) << flight.story();
  const auto told = said_about(*shown, "traffic");
  ASSERT_GT(told.size(), 30U) << "once a second";
  EXPECT_EQ(told.back().at("aircraft").size(), 3U);
  EXPECT_EQ(times_in(flight.story(), "aircraft close: SIM0, "), 1U) << flight.story();
  EXPECT_EQ(times_in(alone.story(), "aircraft close: "), 0U);
  EXPECT_EQ(commands_of(flight), commands_of(alone));
  EXPECT_EQ(flaw_of_reports(flight), "");
}

TEST_F(views, a_stream_that_crashes_hangs_or_is_given_up_does_not_touch_the_flight) {
  ASSERT_TRUE(flight.run_until_phase(phase::flying, 120)) << flight.story();
  for (const auto point : {runtime::crash_point::before_handler, runtime::crash_point::after_handler}) {
    flight.process()->crash_at("telemetry_stream", point);
    flight.run_for(3);
  }
  ASSERT_TRUE(flight.give_up("telemetry_stream")) << flight.story();
  ASSERT_TRUE(flight.run_until_phase(phase::done)) << flight.story();
  EXPECT_EQ(flight.processes(), 1) << flight.story();
}

TEST_F(views, a_stream_and_a_health_actor_that_hang_do_not_touch_the_flight) {
  ASSERT_TRUE(flight.run_until_phase(phase::flying, 120)) << flight.story();
  flight.process()->hang("telemetry_stream");
  flight.process()->hang("health");
  ASSERT_TRUE(flight.run_until_phase(phase::done)) << flight.story();
  EXPECT_EQ(flight.processes(), 1) << flight.story();
}

TEST_F(views, who_only_shows_keeps_no_flight_from_its_start) {
  ASSERT_TRUE(flight.give_up("health")) << flight.story();
  ASSERT_TRUE(flight.run_until_phase(phase::done)) << flight.story();
}

} // namespace views_test
