// What ground stations hear of a flight through the port of the whole daemon: each item once, each sentence once, and
// streams at the rates that they are promised.
#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "actors/domain/vehicle_text/vehicle_text.hpp"
#include "actors/ground_port/settings.hpp"
#include "programs/godwit-drill/flight_simulation/flight_simulation.hpp"
#include "tests/support/station_items.hpp"

namespace station_reports_test {

using namespace godwit;
using namespace godwit::drill;
using executor::phase;
namespace mavlink = io::mavlink;

class station_reports : public testing::TestWithParam<sim::personality> {
protected:
  explicit station_reports() : flight(by_stations()) {
    flight.station().listen([this](const mavlink::frame_view& frame) {
      ++heard[frame.id()];
      if (frame.id() == mavlink::mission_item_reached::message_id)
        reached.push_back(mavlink::decode<mavlink::mission_item_reached>(frame).seq);
      if (frame.id() != mavlink::statustext::message_id)
        return;
      const auto text = mavlink::decode<mavlink::statustext>(frame);
      if (text.chunk_seq == 0)
        texts.push_back({text.severity, {}});
      texts.back().text += flight::text_of(text);
    });
  }
  [[nodiscard]] static flight_simulation::options by_stations() {
    flight_simulation::options result;
    result.who = GetParam();
    result.starts_by_itself = false;
    result.speaks_as_autopilot = true;
    result.has_service = false;
    result.speed = 1;
    result.stream_factor = 1;
    result.is_shuffled = false;
    return result;
  }
  testing::AssertionResult begin_flight() {
    if (!flight.run_until_phase(phase::connected, 60))
      return testing::AssertionFailure() << "not connected. " << flight.story();
    flight.station().upload(tests::station_items(GetParam()));
    if (!flight.run_until_phase(phase::ready, 120))
      return testing::AssertionFailure() << flight.story();
    flight.run_for(2.5);
    flight.station().start_mission();
    if (!flight.run_until_phase(phase::flying, 60))
      return testing::AssertionFailure() << flight.story();
    return testing::AssertionSuccess();
  }
  [[nodiscard]] bool run_until_reached(std::size_t items) {
    return flight.run_until([&] { return reached.size() >= items; }, 300);
  }
  [[nodiscard]] bool is_each_reached_once() const {
    return std::ranges::adjacent_find(reached, std::greater_equal<>()) == reached.end();
  }

  std::map<std::uint32_t, int> heard;
  std::vector<std::uint16_t> reached;
  struct heard_text {
    std::uint8_t severity = 0;
    std::string text;
    bool operator==(const heard_text&) const = default;
  };
  std::vector<heard_text> texts;
  flight_simulation flight;
};

TEST_P(station_reports, what_was_reached_is_not_told_again_after_the_vehicle_was_not_heard_or_the_process_killed) {
  ASSERT_TRUE(begin_flight());
  ASSERT_TRUE(run_until_reached(2)) << flight.story();
  flight.cut_line(6);
  flight.run_for(12);
  EXPECT_TRUE(is_each_reached_once()) << flight.story();
  flight.kill_process();
  flight.run_for(5);
  EXPECT_TRUE(is_each_reached_once()) << testing::PrintToString(reached) << flight.story();
  ASSERT_TRUE(flight.run_until_phase(phase::done, 400)) << flight.story();
  EXPECT_TRUE(is_each_reached_once()) << testing::PrintToString(reached) << flight.story();
}

TEST_P(station_reports, no_sentence_comes_twice_and_none_looks_like_a_failed_check) {
  ASSERT_TRUE(begin_flight());
  ASSERT_TRUE(flight.run_until_phase(phase::done, 400)) << flight.story();
  ASSERT_GT(texts.size(), 5U);
  for (const auto& each : texts) {
    const bool has_failed = each.severity <= mavlink::number(mavlink::mav_severity::warning);
    EXPECT_TRUE(has_failed || !each.text.starts_with("preflight")) << each.text;
    EXPECT_EQ(each.text.find("the vehicle says"), std::string::npos) << each.text;
  }
  const auto twice = std::ranges::adjacent_find(texts);
  EXPECT_TRUE(twice == texts.end()) << twice->text;
}

TEST_P(station_reports, streams_come_at_the_rate_that_is_promised_within_5_percent) {
  ASSERT_TRUE(begin_flight());
  flight.run_for(5);
  const auto before = heard;
  constexpr double measured_s = 40;
  flight.run_for(measured_s);
  for (const auto& each : ground_port::default_rates()) {
    const double promised = measured_s * 1'000 / static_cast<double>(each.least_interval_ms);
    const auto found = before.find(each.message);
    const auto came = heard[each.message] - (found == before.end() ? 0 : found->second);
    EXPECT_NEAR(came, promised, promised * 0.05) << "message " << each.message;
  }
}

TEST_P(station_reports, the_mission_mode_after_a_go_to_leads_back_to_the_mission) {
  ASSERT_TRUE(begin_flight());
  ASSERT_TRUE(run_until_reached(1)) << flight.story();
  flight.run_for(3);
  const auto before = flight.station().current()->seq;
  const auto here = flight.vehicle().describe().where;
  mavlink::command_int there{.target_system = 1, .target_component = 1};
  there.command = mavlink::number(mavlink::mav_cmd::do_reposition);
  there.frame = mavlink::number(mavlink::mav_frame::global_relative_alt);
  there.param1 = -1;
  there.x = static_cast<std::int32_t>(here.latitude_deg * 1e7) + 3'000;
  there.y = static_cast<std::int32_t>(here.longitude_deg * 1e7) + 3'000;
  there.z = 15;
  flight.station().send(there);
  flight.run_for(25);
  EXPECT_EQ(flight.station().result_of(mavlink::mav_cmd::do_reposition), 0) << flight.story();
  EXPECT_EQ(flight.station().current()->seq, before) << flight.story();
  const bool is_px4 = GetParam() == sim::personality::px4;
  flight.station().command(mavlink::mav_cmd::do_set_mode, 1, is_px4 ? 4 : 3, is_px4 ? 4 : 0);
  ASSERT_TRUE(flight.run_until_phase(phase::done, 400)) << flight.story();
  EXPECT_EQ(flight.station().result_of(mavlink::mav_cmd::do_set_mode), 0);
  EXPECT_TRUE(std::ranges::is_sorted(reached)) << testing::PrintToString(reached) << flight.story();
  EXPECT_GT(reached.size(), 2U) << flight.story();
}

// Of an ArduCopter the simulated one says so; on a PX4, which has room for 2,000, the port (ground.max_items).
TEST_P(station_reports, a_plan_for_which_the_vehicle_has_no_room_is_no_space_and_the_one_before_is_flown) {
  ASSERT_TRUE(flight.run_until_phase(phase::connected, 60)) << flight.story();
  const auto items = tests::station_items(GetParam());
  const auto upload = [&](const tests::upload& plan) {
    flight.run_for(3);
    flight.station().upload(plan);
    (void)flight.run_until([&] { return flight.station().plan_answer().has_value(); }, 20);
    return flight.station().plan_answer();
  };
  auto all = items;
  const auto waypoint = items.at(items.size() - 2);
  const std::size_t too_many = GetParam() == sim::personality::px4 ? 1'050 : 700;
  while (all.size() < too_many) {
    all.insert(all.end() - 1, waypoint);
    all[all.size() - 2].x += static_cast<std::int32_t>(all.size()) * 10;
  }
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i].seq = static_cast<std::uint16_t>(i);
  EXPECT_EQ(upload(items), mavlink::number(mavlink::mav_mission_result::accepted)) << flight.story();
  ASSERT_TRUE(flight.run_until_phase(phase::ready, 60)) << flight.story();
  const auto count = flight.vehicle().describe().mission_count;
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(upload(all), mavlink::number(mavlink::mav_mission_result::no_space)) << flight.story();
    ASSERT_TRUE(flight.run_until_phase(phase::ready, 60)) << flight.story();
    EXPECT_EQ(flight.vehicle().describe().mission_count, count) << flight.story();
    EXPECT_EQ(flight.station().current()->seq, 0);
  }
  for (const auto& each : texts)
    EXPECT_EQ(each.text.find(std::to_string(all.size()) + " items taken"), std::string::npos) << each.text;
  EXPECT_EQ(upload(items), mavlink::number(mavlink::mav_mission_result::accepted)) << flight.story();
  ASSERT_TRUE(flight.run_until_phase(phase::ready, 60)) << flight.story();
  flight.station().start_mission();
  EXPECT_TRUE(flight.run_until_phase(phase::flying, 60)) << flight.story();
}

INSTANTIATE_TEST_SUITE_P(of_both_autopilots, station_reports,
                         testing::Values(sim::personality::px4, sim::personality::ardupilot),
                         [](const auto& who) { return std::string(io::name_of(who.param)); });

} // namespace station_reports_test
