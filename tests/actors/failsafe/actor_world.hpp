// A process with the failsafe in virtual time, and around it what it speaks with: a vehicle behind a link that answers,
// is silent or refuses, a ground station that comes and goes, an executor that can die, people who read. Only the
// failsafe is real. Destroying the process is SIGKILL; vehicle and log outlive it. Thread: one.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "actors/failsafe/actor.hpp"
#include "io/mavlink/enums.hpp"
#include "runtime/simulation/simulation.hpp"
#include "tests/actors/failsafe/positions.hpp"

namespace godwit::tests {

namespace mavlink = io::mavlink;

inline constexpr std::uint32_t px4_mission = 4U << 16U | 4U << 24U;
inline constexpr std::uint32_t px4_return = 4U << 16U | 5U << 24U;
inline constexpr std::uint32_t px4_land = 4U << 16U | 6U << 24U;
inline constexpr std::uint32_t px4_hold = 4U << 16U | 3U << 24U;
inline constexpr std::uint32_t px4_position = 3U << 16U; // a pilot's

// A vehicle with PX4, as it is, and what its streams bring.
struct flown_vehicle {
  mavlink::mav_type type = mavlink::mav_type::quadrotor;
  std::uint32_t mode = px4_mission;
  double east_m = 0;
  int battery_percent = 80;
  bool operator_there = true;
  bool is_silent = false;     // commands are lost
  bool answers_looks = false; // REQUEST_MESSAGE brings what it asks for
  bool streams = true;
  std::int64_t position_every_ms = 200;
  std::int64_t obeys_after_ms = 40;
  std::optional<vehicle_link::command_verdict> verdict; // instead of accepted; then it does not obey
};

// What came out of the failsafe, in order, outside of every actor.
struct flight_log {
  struct command {
    std::int64_t at_ns = 0;
    std::uint16_t number = 0;
    float param1 = 0;
  };
  std::vector<command> commands; // but for REQUEST_MESSAGE
  std::vector<command> looks;    // REQUEST_MESSAGE
  std::vector<vehicle_link::set_mode> modes;
  std::vector<failsafe::failsafe_status> failsafe_statuses;
  std::vector<std::string> order;  // "failsafe_status", "command"
  std::vector<std::string> texts;  // to people
  std::vector<std::string> logged; // the same, in the program's log
  [[nodiscard]] int returns() const;
};

[[nodiscard]] runtime::child_policy patient();
// The first crash is the last.
[[nodiscard]] runtime::child_policy mortal();

class failsafe_process {
public:
  failsafe_process(runtime::simulated_disk& disk, flown_vehicle& vehicle, flight_log& log,
                   const failsafe::settings& configured = {});

  runtime::simulation world;
  failsafe::own_handle failsafe;

  // Lets time pass in steps of 10 ms; the streams and the ground station bring what they bring.
  void run_ms(std::int64_t ms);
  void run_s(std::int64_t s) { run_ms(1'000 * s); }

  // Inside of a square of 200 m around home, as the executor says it.
  [[nodiscard]] failsafe::guard_answer guard();
  [[nodiscard]] failsafe::failsafe_status stands();
  [[nodiscard]] runtime::health_entry health();
  [[nodiscard]] std::int64_t now_ms() const { return world.now_ns() / failsafe::ns_per_ms; }

private:
  void speak();
  void say_heartbeat();
  void say_position();
  void obey();
  void answer_looks();

  flown_vehicle& vehicle_;
  flight_log& log_;
  std::size_t obeyed_ = 0;
  std::size_t looked_ = 0;
  std::int64_t heard_ms_ = -1;
};

} // namespace godwit::tests
