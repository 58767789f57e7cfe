// What the failsafe hears. Each comes with the instant at which it came; nothing is decided before the next tick, and
// so the order within a tick does not matter. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "io/fields/field_table.hpp"
#include "io/mavlink/enums/vehicle.hpp"
#include "io/time_units.hpp"
#include "messages/failsafe/types.hpp"
#include "messages/flight/flight_mode.hpp"
#include "messages/flight/vehicle_class.hpp"
#include "messages/vehicle_link/command.hpp"
#include "messages/vehicle_link/evidence.hpp"

namespace godwit::failsafe {

// What a failsafe has to know of the vehicle: what it is, what its mode comes down to, and whether it stands.
//
// Every autopilot numbers its modes in its own way. Whoever reads the heartbeat says what a number comes down to; the
// number itself is kept too, because a change between two modes of one kind is a change all the same. Thread: plain
// values.
using flight::flight_mode;
using flight::mode_kind;
using flight::vehicle_class;

// As EXTENDED_SYS_STATE says it.
enum class landed_state { unknown, on_ground, in_air, taking_off, landing };

// -- from the vehicle ------------------------------------------------------------------------------

struct heartbeat {
  vehicle_class what = vehicle_class::unknown;
  bool armed = false;
  flight_mode mode;
  io::mavlink::mav_autopilot autopilot = io::mavlink::mav_autopilot::generic;
  bool is_critical = false; // MAV_STATE_CRITICAL: the autopilot says that something is wrong
};

// CURRENT_MODE: the mode that it is in, and the one that somebody has asked for last (0: not told).
struct modes_told {
  std::uint32_t actual = 0;
  std::uint32_t intended = 0;
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
  std::uint32_t boot_ms = 0; // the vehicle's clock: two positions are two when it has gone on between them
};

// Where its own return leads.
struct home_told {
  flight::home_place where;
};

struct battery {
  int percent = -1; // -1: the autopilot does not know
};

// Which item of its plan the vehicle is at.
struct mission_current {
  std::uint16_t sequence = 0;
  bool is_complete = false;
};

// What it says in words (STATUSTEXT).
struct autopilot_text {
  std::string what;
};

// What became of a command that the failsafe sent.
struct command_resolved {
  std::uint64_t number = 0; // of the command
  vehicle_link::command_verdict verdict = vehicle_link::command_verdict::not_sent;
};

// -- from the ground -------------------------------------------------------------------------------

// As ground_port tells it once a second.
struct operator_heard {
  bool ever_heard = false;
  std::int64_t age_ms = -1; // since the last heartbeat of any station
};

// Whoever has control by operator_bridge, just now.
struct controller_heard {};

// What others ask for has the id of the request, which the answer carries. It is whole as it comes: see the messages.
struct asked_override {
  std::uint64_t request_id = 0;
  override_rule what;
};

// -- from the executor -----------------------------------------------------------------------------

struct asked_guard {
  std::uint64_t request_id = 0;
  guard_mission what;
};

using event =
    std::variant<heartbeat, modes_told, landed, position, home_told, battery, mission_current, autopilot_text,
                 command_resolved, operator_heard, controller_heard, asked_override, hand_back, asked_guard,
                 expect_mode, taken_over, command_pending, following, vehicle_link::foreign_act, return_taken>;

using godwit::instant;
using godwit::ns_per_ms;
using godwit::ns_per_s;

// All decisions fall on a tick. From a breach to the command it takes at most one of them.
inline constexpr std::int64_t tick_ms = 100;

} // namespace godwit::failsafe
