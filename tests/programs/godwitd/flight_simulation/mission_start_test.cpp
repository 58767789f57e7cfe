// MISSION_START as the requirement has it (FR-00089), by a station at the port of the whole daemon: each acceptance
// criterion and each risk, with the real executor behind the port and a simulated vehicle behind that.
#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "programs/godwit-drill/flight_simulation/flight_simulation.hpp"
#include "tests/support/station_items.hpp"

namespace mission_start_test {

using namespace godwit;
using namespace godwit::drill;
using executor::phase;
using io::mavlink::mav_result;
using io::mavlink::mission_state;

class start_at_port : public testing::TestWithParam<sim::personality> {
protected:
  explicit start_at_port(const flight_simulation::options& wanted = by_stations()) : flight(wanted) {
    flight.station().listen([this](const io::mavlink::frame_view& frame) {
      if (frame.id() == io::mavlink::mission_item_reached::message_id)
        reached.push_back(io::mavlink::decode<io::mavlink::mission_item_reached>(frame).seq);
    });
  }

  [[nodiscard]] static flight_simulation::options by_stations() {
    return {
        .who = GetParam(), .starts_by_itself = false, .speaks_as_autopilot = true, .has_service = false, .speed = 5};
  }
  [[nodiscard]] static bool drives() { return GetParam() == sim::personality::rover; }
  [[nodiscard]] static std::uint16_t first_waypoint() { return drives() ? 1 : 2; }
  [[nodiscard]] std::uint16_t last_item() const { return static_cast<std::uint16_t>(items.size() - 1); }

  testing::AssertionResult bring() {
    if (!flight.run_until_phase(phase::connected, 60))
      return testing::AssertionFailure() << "not connected. " << flight.story();
    flight.station().upload(items);
    const bool is_answered = flight.run_until([&] { return flight.station().plan_answer().has_value(); }, 10);
    if (!is_answered || *flight.station().plan_answer() != 0 || !flight.run_until_phase(phase::ready, 120))
      return testing::AssertionFailure() << flight.story();
    return testing::AssertionSuccess();
  }
  // The result of a start; none: there was no answer.
  std::optional<mav_result> start(float first = 0, float last = 0) {
    flight.run_for(2.5); // so that it is no repetition of the one before
    flight.station().start_mission(first, last);
    (void)flight.run_until([&] { return flight.station().start_answer().has_value(); }, 25);
    const auto& answer = flight.station().start_answer();
    return answer ? std::optional(static_cast<mav_result>(answer->result)) : std::nullopt;
  }
  [[nodiscard]] bool shows(std::uint16_t item, double within_s = 120) {
    return flight.run_until([&] { return flight.station().current() && flight.station().current()->seq == item; },
                            within_s);
  }
  [[nodiscard]] bool is_in_mission_mode() {
    const auto mode = flight.vehicle().describe().mode;
    return mode == "AUTO" || mode == "AUTO.MISSION";
  }

  std::vector<std::uint16_t> reached; // as the station hears it
  flight_simulation flight;
  tests::upload items = tests::station_items(GetParam());
};

// -- acceptance criteria ------------------------------------------------------------------------------

TEST_P(start_at_port, FR_00089_mission_start_is_handled_and_success_is_accepted) {
  ASSERT_TRUE(bring());
  EXPECT_EQ(start(), mav_result::accepted) << flight.story();
  EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
}

TEST_P(start_at_port, FR_00089_it_changes_to_the_mission_mode_before_it_is_accepted) {
  ASSERT_TRUE(bring());
  EXPECT_FALSE(is_in_mission_mode()) << flight.story();
  EXPECT_EQ(start(), mav_result::accepted) << flight.story();
  EXPECT_TRUE(is_in_mission_mode()) << flight.story();
}

TEST_P(start_at_port, FR_00089_an_empty_mission_fails) {
  ASSERT_TRUE(flight.run_until_phase(phase::connected, 60)) << flight.story();
  EXPECT_EQ(start(), mav_result::failed) << flight.story();
  ASSERT_TRUE(bring());
  flight.station().clear_mission();
  ASSERT_TRUE(flight.run_until([&] { return flight.station().plan_answer().has_value(); }, 10)) << flight.story();
  EXPECT_EQ(start(), mav_result::failed) << "and one that was cleared";
  EXPECT_FALSE(flight.vehicle().describe().armed);
}

TEST_P(start_at_port, FR_00089_the_mission_is_active_then) {
  ASSERT_TRUE(bring());
  EXPECT_EQ(flight.station().current()->mission_state, io::mavlink::number(mission_state::not_started));
  EXPECT_EQ(start(), mav_result::accepted) << flight.story();
  EXPECT_TRUE(flight.run_until(
      [&] { return flight.station().current()->mission_state == io::mavlink::number(mission_state::active); }, 2))
      << flight.story();
}

TEST_P(start_at_port, FR_00089_it_begins_with_the_first_item) {
  ASSERT_TRUE(bring());
  ASSERT_EQ(start(), mav_result::accepted) << flight.story();
  EXPECT_LE(flight.station().current()->seq, first_waypoint()) << flight.story();
  EXPECT_TRUE(shows(first_waypoint())) << flight.story();
  EXPECT_TRUE(shows(first_waypoint() + 1)) << flight.story();
}

// A rover that stands takes the part as one that is disarmed does; what flies would have to take off first.
TEST_P(start_at_port, FR_00089_a_part_is_flown_on_a_rover_that_is_armed_already) {
  if (!drives())
    return;
  ASSERT_TRUE(bring());
  flight.station().command(io::mavlink::mav_cmd::component_arm_disarm, 1);
  ASSERT_TRUE(flight.run_until([&] { return flight.vehicle().describe().armed; }, 5)) << flight.story();
  ASSERT_EQ(start(1, 2), mav_result::accepted) << flight.story();
  EXPECT_TRUE(shows(1)) << flight.story();
  EXPECT_TRUE(shows(2)) << flight.story();
  EXPECT_TRUE(flight.run_until([&] { return reached.size() == 2; }, 200)) << flight.story();
  flight.run_for(30);
  EXPECT_EQ(reached, (std::vector<std::uint16_t>{1, 2})) << flight.story();
}

// What flies takes off first, and skips what stands between.
TEST_P(start_at_port, FR_00089_or_with_the_item_that_is_named) {
  ASSERT_TRUE(bring());
  const auto second = static_cast<std::uint16_t>(first_waypoint() + 1);
  ASSERT_EQ(start(second, last_item()), mav_result::accepted) << flight.story();
  const auto has_been_at_first = [&] { return flight.station().current()->seq == first_waypoint(); };
  EXPECT_FALSE(
      flight.run_until([&] { return has_been_at_first() || flight.station().current()->seq == second; }, 120) &&
      has_been_at_first())
      << flight.story();
  EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
}

TEST_P(start_at_port, FR_00089_without_a_mission_it_fails_also_for_one_item) {
  ASSERT_TRUE(flight.run_until_phase(phase::connected, 60)) << flight.story();
  EXPECT_EQ(start(1, 1), mav_result::failed) << flight.story();
}

TEST_P(start_at_port, FR_00089_a_statustext_says_mission_started) {
  ASSERT_TRUE(bring());
  EXPECT_FALSE(flight.station().was_told("Mission started"));
  ASSERT_EQ(start(), mav_result::accepted) << flight.story();
  EXPECT_TRUE(flight.run_until([&] { return flight.station().was_told("Mission started"); }, 2)) << flight.story();
}

// -- risks, and the order of the answers ----------------------------------------------------------------

TEST_P(start_at_port, FR_00089_an_item_after_the_end_fails_and_a_wrong_last_one_is_denied) {
  ASSERT_TRUE(bring());
  const auto count = static_cast<float>(items.size());
  EXPECT_EQ(start(count), mav_result::failed) << flight.story();
  EXPECT_EQ(start(0, count), mav_result::denied);
  EXPECT_EQ(start(2, 1), mav_result::denied);
  EXPECT_EQ(start(0.5), mav_result::denied);
  EXPECT_EQ(start(-1), mav_result::denied);
  EXPECT_EQ(start(std::numeric_limits<float>::quiet_NaN()), mav_result::denied);
  EXPECT_EQ(start(std::numeric_limits<float>::quiet_NaN(), count), mav_result::denied) << "before all else";
  EXPECT_EQ(start(count, count), mav_result::failed) << "the first item before the last one";
  EXPECT_FALSE(flight.vehicle().describe().armed);
  EXPECT_EQ(flight.status().now, phase::ready) << flight.story();
}

TEST_P(start_at_port, FR_00089_while_a_plan_is_uploaded_it_is_rejected_for_now) {
  ASSERT_TRUE(bring());
  flight.station().send(io::mavlink::mission_count{.target_system = 1, .target_component = 1, .count = 3});
  flight.station().start_mission();
  ASSERT_TRUE(flight.run_until([&] { return flight.station().start_answer().has_value(); }, 5)) << flight.story();
  EXPECT_EQ(flight.station().start_answer()->result, io::mavlink::number(mav_result::temporarily_rejected));
}

TEST_P(start_at_port, FR_00089_in_flight_it_goes_on_at_the_item_that_is_named) {
  ASSERT_TRUE(bring());
  ASSERT_EQ(start(), mav_result::accepted) << flight.story();
  ASSERT_TRUE(shows(first_waypoint() + 1)) << flight.story();
  EXPECT_EQ(start(first_waypoint(), last_item()), mav_result::accepted) << flight.story();
  EXPECT_TRUE(shows(first_waypoint(), 5)) << flight.story();
  EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, start_at_port,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot,
                                         sim::personality::plane),
                         [](const auto& who) { return std::string(io::name_of(who.param)); });

// It arms nothing by itself.
class start_of_disarmed : public start_at_port {
protected:
  void SetUp() override {
    ASSERT_TRUE(bring());
    ASSERT_FALSE(flight.vehicle().describe().armed);
  }
  static flight_simulation::options without_arming() {
    auto result = by_stations();
    result.arms_on_start = false;
    return result;
  }
  start_of_disarmed() : start_at_port(without_arming()) {}
};

TEST_P(start_of_disarmed, FR_00089_a_disarmed_vehicle_is_denied_a_start) {
  EXPECT_EQ(start(), mav_result::denied) << flight.story();
  EXPECT_TRUE(flight.run_until([&] { return flight.station().was_told("disarmed"); }, 5)) << flight.story();
  EXPECT_FALSE(flight.vehicle().describe().armed);
}

TEST_P(start_of_disarmed, FR_00089_failing_checks_come_before_being_disarmed) {
  flight.vehicle().set_battery(5, flight.now_ns());
  flight.run_for(8);
  EXPECT_EQ(start(), mav_result::temporarily_rejected) << flight.story();
  EXPECT_EQ(start(static_cast<float>(items.size())), mav_result::failed) << "the item before the checks";
  EXPECT_FALSE(flight.vehicle().describe().armed);
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, start_of_disarmed,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot,
                                         sim::personality::plane),
                         [](const auto& who) { return std::string(io::name_of(who.param)); });

} // namespace mission_start_test
