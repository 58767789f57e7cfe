// A station replaces its plan in flight at the port of the whole daemon: pause, upload, choose an item, start; also
// when the process is killed at any commit of the upload.
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "programs/godwit-drill/flight_simulation/flight_simulation.hpp"
#include "tests/support/station_items.hpp"

namespace upload_in_flight_test {

using namespace godwit;
using namespace godwit::drill;
using side = flight_simulation::side;
using executor::pause_cause;
using executor::phase;
using io::mavlink::mav_cmd;

class upload_at_port : public testing::TestWithParam<sim::personality> {
protected:
  [[nodiscard]] static flight_simulation::options by_stations(std::uint64_t seed = 1) {
    flight_simulation::options result;
    result.who = GetParam();
    result.seed = seed;
    result.starts_by_itself = false;
    result.speaks_as_autopilot = true;
    result.has_service = false;
    result.speed = 3;
    return result;
  }
  [[nodiscard]] static bool drives() { return GetParam() == sim::personality::rover; }
  [[nodiscard]] static std::uint16_t first_waypoint() { return drives() ? 1 : 2; }
  // What MISSION_CURRENT of such a vehicle counts: an ArduPilot leaves its home line out.
  [[nodiscard]] std::size_t counted_of_second() const {
    const bool has_home = GetParam() == sim::personality::ardupilot || GetParam() == sim::personality::plane;
    return second.size() - (has_home ? 1 : 0);
  }

  [[nodiscard]] static bool upload(flight_simulation& flight, const tests::upload& items, double within_s = 40) {
    flight.station().upload(items);
    (void)flight.run_until([&] { return flight.station().plan_answer().has_value(); }, within_s);
    return flight.station().plan_answer() == std::uint8_t{0};
  }
  [[nodiscard]] static bool start(flight_simulation& flight) {
    flight.station().start_mission();
    (void)flight.run_until([&] { return flight.station().start_answer().has_value(); }, 25);
    return flight.station().start_answer() && flight.station().start_answer()->result == 0;
  }
  static void pause(flight_simulation& flight) {
    flight.station().command(mav_cmd::do_pause_continue, 0);
    (void)flight.run_until_phase(phase::paused, 15);
    flight.run_for(2);
  }
  // On its way to the second waypoint, and paused there.
  [[nodiscard]] testing::AssertionResult fly_and_pause(flight_simulation& flight) const {
    const bool is_connected = flight.run_until_phase(phase::connected, 60);
    if (!is_connected || !upload(flight, first) || !flight.run_until_phase(phase::ready, 60) || !start(flight))
      return testing::AssertionFailure() << flight.story();
    const bool flies = flight.run_until([&] { return flight.station().current()->seq == first_waypoint() + 1; }, 120);
    pause(flight);
    return flies && flight.status().cause == pause_cause::asked ? testing::AssertionSuccess()
                                                                : testing::AssertionFailure() << flight.story();
  }
  // Whoever stands at the station does it again until it is done.
  [[nodiscard]] testing::AssertionResult upload_and_start_again(flight_simulation& flight) const {
    for (int tries = 0; tries < 8; ++tries) {
      flight.run_for(3);
      const auto& now = flight.status();
      if (now.now == phase::flying)
        pause(flight);
      else if (now.now == phase::paused && now.cause != pause_cause::asked)
        flight.say(operators::command_kind::resume);
      else if (upload(flight, second)) {
        flight.run_for(2.5);
        if (start(flight))
          return testing::AssertionSuccess();
      }
    }
    return testing::AssertionFailure() << flight.story();
  }

  tests::upload first = tests::station_items(GetParam());
  tests::upload second = [] {
    auto result = tests::station_items(GetParam());
    result[first_waypoint()] = tests::waypoint_at(GetParam(), -40, 20);
    result.insert(result.begin() + first_waypoint() + 1, tests::waypoint_at(GetParam(), -40, -40));
    return tests::numbered(result);
  }();
};

TEST_P(upload_at_port, pause_upload_choose_an_item_and_start_fly_the_new_plan_from_there) {
  flight_simulation flight(by_stations());
  ASSERT_TRUE(fly_and_pause(flight));
  ASSERT_TRUE(upload(flight, second)) << flight.story();
  EXPECT_EQ(flight.status().now, phase::paused) << flight.story();
  const auto chosen = static_cast<std::uint16_t>(first_waypoint() + 1);
  flight.station().command(mav_cmd::do_set_mission_current, chosen);
  ASSERT_TRUE(
      flight.run_until([&] { return flight.station().result_of(mav_cmd::do_set_mission_current).has_value(); }, 5));
  EXPECT_EQ(flight.station().result_of(mav_cmd::do_set_mission_current), 0) << flight.story();
  flight.run_for(5);
  EXPECT_EQ(flight.status().now, phase::paused) << "who chooses an item has not said that it goes on";
  EXPECT_EQ(flight.station().current()->seq, chosen);
  EXPECT_EQ(flight.station().current()->total, counted_of_second());
  ASSERT_TRUE(start(flight)) << flight.story();
  ASSERT_TRUE(flight.run_until_phase(phase::flying, 10)) << flight.story();
  flight.run_for(1.5);
  EXPECT_EQ(flight.station().current()->seq, chosen) << flight.story();
  EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
}

TEST_P(upload_at_port, a_kill_at_any_commit_of_it_moves_nothing_and_what_is_said_again_is_flown) {
  constexpr std::uint64_t most_commits = 24;
  int kills = 0;
  for (std::uint64_t n = 1; n <= most_commits; ++n) {
    const auto where = n % 2 == 0 ? side::before : side::after;
    SCOPED_TRACE("commit " + std::to_string(n) + (where == side::before ? " before" : " after"));
    flight_simulation flight(by_stations(n));
    ASSERT_TRUE(fly_and_pause(flight));
    flight.kill_process_at_commit(flight.commits() + n, where);
    flight.station().upload(second);
    (void)flight.run_until([&] { return flight.processes() > 1 || flight.station().plan_answer().has_value(); }, 30);
    if (flight.processes() == 1)
      break; // it was over before
    ++kills;
    flight.run_for(8);
    EXPECT_EQ(flight.status().now, phase::paused) << "no restart lets it fly: " << flight.story();
    ASSERT_TRUE(upload_and_start_again(flight));
    EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
    EXPECT_EQ(flight.station().current()->total, counted_of_second()) << flight.story();
    EXPECT_FALSE(flight.sent_without_intent());
    if (HasFailure())
      return;
  }
  RecordProperty("kills", kills);
  EXPECT_GE(kills, 4);
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, upload_at_port,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot,
                                         sim::personality::plane),
                         [](const auto& who) { return std::string(io::name_of(who.param)); });

} // namespace upload_in_flight_test
