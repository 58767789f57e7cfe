// What the failsafe hears. Each comes with the instant at which it came; nothing is decided before the next tick, and
// so the order within a tick does not matter. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "actors/failsafe/rules.hpp"
#include "actors/failsafe/vehicle.hpp"
#include "io/fields/field_table.hpp"
#include "messages/mission/document.hpp"
#include "messages/vehicle_link/command.hpp"

namespace godwit::failsafe {

// -- from the vehicle ------------------------------------------------------------------------------

struct heartbeat {
  vehicle_class what = vehicle_class::unknown;
  bool armed = false;
  flight_mode mode;
};

struct landed {
  landed_state how = landed_state::unknown;
};

struct position {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double altitude_m = 0; // above the place of take-off
  double north_mps = 0;
  double east_mps = 0;
  double down_mps = 0;
};

struct battery {
  int percent = -1; // -1: the autopilot does not know
};

// Which item of its plan the vehicle is at.
struct mission_current {
  std::uint16_t sequence = 0;
};

// What became of a command that the failsafe sent.
struct command_settled {
  std::uint64_t number = 0; // of the command
  vehicle_link::command_verdict verdict = vehicle_link::command_verdict::not_sent;
};

// -- from the ground -------------------------------------------------------------------------------

// As ground_port tells it once a second.
struct operator_heard {
  bool ever_heard = false;
  std::int64_t age_ms = -1; // since the last heartbeat of any station
};

// An authenticated operator wants that a rule does not act until the deadline. What it has done already is lifted.
struct override_rule {
  std::uint64_t key = 0; // the answer carries it
  rule scope = rule::operator_link;
  std::string reason;
  std::int64_t until_ns = 0; // wall clock

  static constexpr auto fields = io::table(
      "failsafe.override_rule", io::field("key", &override_rule::key), io::field("scope", &override_rule::scope),
      io::field("reason", &override_rule::reason), io::field("until_ns", &override_rule::until_ns));
};

// An operator gives the vehicle back to the mission: after a takeover, or after a failsafe that has done its work. All
// latches fall, and what still holds then acts anew.
struct hand_back {
  static constexpr auto fields = io::table("failsafe.hand_back");
};

// -- from the executor -----------------------------------------------------------------------------

// What the mission says about the limits of the flight. It replaces what was said before.
struct flight_limits {
  std::vector<mission::geofence> geofences;
  std::optional<std::uint16_t> land_start; // sequence of DO_LAND_START in the plan on the vehicle, as that counts

  static constexpr auto fields = io::table("failsafe.flight_limits", io::field("geofences", &flight_limits::geofences),
                                           io::field("land_start", &flight_limits::land_start));
  friend bool operator==(const flight_limits&, const flight_limits&) = default;
};

// The next change into such a mode is ours: it was commanded, or the plan leads there by itself (a plan that ends with
// a return, a vehicle that holds after its last item). Said before the command goes out.
struct expect_mode {
  mode_kind kind = mode_kind::unknown;
  std::int64_t lasts_ms = 0; // 0: to the end of the flight

  static constexpr auto fields = io::table("failsafe.expect_mode", io::field("kind", &expect_mode::kind),
                                           io::field("lasts_ms", &expect_mode::lasts_ms));
};

// The executor has seen that a pilot took the vehicle.
struct taken_over {
  static constexpr auto fields = io::table("failsafe.taken_over");
};

struct following {
  bool on = false; // an object is followed

  static constexpr auto fields = io::table("failsafe.following", io::field("on", &following::on));
};

using event = std::variant<heartbeat, landed, position, battery, mission_current, command_settled, operator_heard,
                           override_rule, hand_back, flight_limits, expect_mode, taken_over, following>;

} // namespace godwit::failsafe
