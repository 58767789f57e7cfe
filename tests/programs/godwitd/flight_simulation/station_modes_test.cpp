// Each mode of each vehicle, as ground stations send it, in each phase of a flight, at the port of the whole daemon:
// what a direct line would have done is done, and nobody hears ACCEPTED before the vehicle has got it or is in that
// mode.
#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "actors/domain/flight_mode/flight_modes.hpp"
#include "programs/godwit-drill/flight_simulation/flight_simulation.hpp"
#include "programs/godwit-drill/flight_simulation/vehicle_modes.hpp"

namespace station_modes_test {

using namespace godwit;
using namespace godwit::drill;
using executor::pause_cause;
using executor::phase;
using flight::mode_kind;
using io::mavlink::mav_cmd;
using io::mavlink::mav_result;

// All with the custom flag: none but that, as MAVSDK sends it to a vehicle that is armed or not, as QGroundControl, and
// all flags at once.
constexpr std::array<std::uint8_t, 8> base_modes{1, 129, 157, 209, 81, 217, 255, 0x8D};

enum class moment { ready, armed, starting, flying, paused, taken_over, coming_home };
constexpr std::array moments{moment::ready,  moment::armed,      moment::starting,   moment::flying,
                             moment::paused, moment::taken_over, moment::coming_home};

// All that godwit has a name for.
std::vector<std::uint32_t> modes_of(sim::personality who) {
  std::vector<std::uint32_t> result;
  const auto add = [&](std::uint32_t mode) {
    if (flight::mode_of(owner_of(who), mode).kind != mode_kind::unknown)
      result.push_back(mode);
  };
  if (who != sim::personality::px4) {
    for (std::uint32_t i = 0; i < 40; ++i)
      add(i);
    return result;
  }
  for (std::uint32_t main = 0; main < 12; ++main)
    for (std::uint32_t sub = 0; sub < 12; ++sub)
      add(main << 16U | sub << 24U);
  return result;
}

class station_modes : public testing::TestWithParam<sim::personality> {
protected:
  // On a line without a delay a start is over at once.
  static flight_simulation::options through_port(std::uint64_t seed, moment at) {
    flight_simulation::options result;
    if (at == moment::starting)
      result.line.in.delay = result.line.out.delay = std::chrono::milliseconds(30);
    result.who = GetParam();
    result.seed = seed;
    result.starts_by_itself = false;
    result.speaks_as_autopilot = true;
    result.speed = 5;
    result.is_shuffled = false;
    return result;
  }

  static void send(flight_simulation& flight, std::uint32_t mode, std::uint8_t base_mode) {
    if (GetParam() == sim::personality::px4)
      flight.station().command(mav_cmd::do_set_mode, base_mode, static_cast<float>(mode >> 16U & 0xFFU),
                               static_cast<float>(mode >> 24U));
    else
      flight.station().command(mav_cmd::do_set_mode, base_mode, static_cast<float>(mode));
  }

  static bool bring_to(flight_simulation& flight, moment to) {
    if (!flight.run_until_phase(phase::ready, 120))
      return false;
    if (to == moment::armed) {
      const auto guided = flight::number_of(owner_of(GetParam()), mode_kind::guided);
      if (GetParam() != sim::personality::px4 && GetParam() != sim::personality::rover)
        send(flight, *guided, 1);
      flight.run_for(1);
      flight.station().command(mav_cmd::component_arm_disarm, 1);
      return flight.run_until([&] { return flight.vehicle().describe().armed; }, 5);
    }
    if (to == moment::ready)
      return true;
    flight.say(operators::command_kind::start);
    if (to == moment::starting)
      return flight.run_until_phase(phase::starting, 5);
    const auto is_off = [&] { return flight.vehicle().describe().in_air || sim::drives(GetParam()); };
    if (!flight.run_until_phase(phase::flying, 60) || !flight.run_until(is_off, 10))
      return false;
    flight.run_for(2);
    switch (to) {
    case moment::paused:
      flight.say(operators::command_kind::pause);
      return flight.run_until_phase(phase::paused, 15);
    case moment::taken_over:
      send(flight, pilot_mode(GetParam()), 1);
      return flight.run_until_phase(phase::paused, 15);
    case moment::coming_home:
      flight.say(operators::command_kind::come_home);
      flight.run_for(2);
      return true;
    default:
      return true;
    }
  }

  // Empty: as on a direct line.
  static std::string flaw(moment at, std::uint32_t mode, std::uint8_t base_mode, std::uint64_t seed) {
    flight_simulation flight(through_port(seed, at));
    if (!bring_to(flight, at))
      return "it did not come so far\n" + flight.story();
    const auto first = flight.orders().size();
    const bool is_mission = flight::mode_of(owner_of(GetParam()), mode).kind == mode_kind::mission;
    const auto has_it = [&] {
      const auto& orders = flight.orders();
      return flight.station().mode() == mode ||
             std::any_of(orders.begin() + static_cast<std::ptrdiff_t>(first), orders.end(), [&](const auto& each) {
               const bool starts = each.command == io::mavlink::number(mav_cmd::mission_start);
               return each.mode == mode || (is_mission && starts);
             });
    };
    const auto result = [&] { return flight.station().result_of(mav_cmd::do_set_mode); };
    bool had_it = has_it();
    send(flight, mode, base_mode);
    (void)flight.run_until(
        [&] {
          had_it = had_it || has_it();
          return result().has_value();
        },
        15);
    const auto said = result();
    if (!said)
      return "no answer\n" + flight.story();
    const bool is_accepted = *said == io::mavlink::number(mav_result::accepted);
    if (is_accepted && !had_it)
      return "accepted, and the vehicle has not got it\n" + flight.story();
    if (!is_mission && !had_it)
      return "refused by " + std::to_string(*said) + ", and not by the vehicle\n" + flight.story();
    if (is_mission && *said == io::mavlink::number(mav_result::denied))
      return "a start is denied\n" + flight.story();
    if (is_mission && !is_accepted && (at == moment::flying || at == moment::paused || at == moment::taken_over))
      return "a direct line would have gone on: " + std::to_string(*said) + '\n' + flight.story();
    return {};
  }
};

TEST_P(station_modes, every_mode_with_any_base_mode_at_any_moment_does_what_a_direct_line_would_do) {
  std::uint64_t number = 0;
  for (const auto at : moments)
    for (const auto mode : modes_of(GetParam())) {
      const auto base_mode = base_modes[number++ % base_modes.size()];
      ASSERT_EQ(flaw(at, mode, base_mode, number), "")
          << "moment " << static_cast<int>(at) << ", mode " << mode << ", base mode " << int(base_mode);
    }
}

// Found with MAVSDK and QGroundControl on a PX4.
TEST_P(station_modes, hold_return_land_and_a_pilots_mode_with_the_armed_flag_reach_a_vehicle_in_flight) {
  const auto who = owner_of(GetParam());
  for (const auto kind : {mode_kind::hold, mode_kind::returning, mode_kind::landing, mode_kind::manual}) {
    const auto mode = flight::number_of(who, kind);
    for (const std::uint8_t base_mode : {129, 157, 209}) {
      if (mode) {
        ASSERT_EQ(flaw(moment::flying, *mode, base_mode, 1), "") << io::name_of(kind) << ' ' << int(base_mode);
      }
    }
  }
}

// As `mode loiter` and `mode auto` of MAVProxy, however fast they follow each other once the first is shown.
TEST_P(station_modes, a_pilots_mode_that_is_shown_and_back_to_the_mission_of_the_same_station_goes_on) {
  if (GetParam() == sim::personality::plane)
    return; // godwit's own hold
  for (const double seconds : {0.05, 0.3, 0.7, 1.2}) {
    auto wanted = through_port(1, moment::flying);
    wanted.speed = 1;
    wanted.stream_factor = 1;
    flight_simulation flight(wanted);
    ASSERT_TRUE(bring_to(flight, moment::flying)) << flight.story();
    const auto pilots = GetParam() == sim::personality::ardupilot ? 5U : pilot_mode(GetParam());
    send(flight, pilots, 1);
    ASSERT_TRUE(flight.run_until([&] { return flight.station().mode() == pilots; }, 5)) << flight.story();
    flight.run_for(seconds);
    send(flight, mission_mode(GetParam()), 1);
    flight.run_for(10);
    EXPECT_EQ(flight.status().now, phase::flying) << seconds << '\n' << flight.story();
    EXPECT_EQ(flight.station().mode(), mission_mode(GetParam())) << seconds << '\n' << flight.story();
  }
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, station_modes,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot,
                                         sim::personality::plane),
                         [](const auto& who) { return std::string(io::name_of(who.param)); });

} // namespace station_modes_test
