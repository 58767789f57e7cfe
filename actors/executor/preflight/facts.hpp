// All that the preflight checks look at, as it is known at this moment.
//
// What is not known, or was heard too long ago to be believed, is left as it is here: with nothing filled in no check
// passes. The mission and its plans are borrowed for the time of one look. Nanoseconds; the wall clock counts since
// 1970 (UTC). Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "actors/executor/plan/fence_check.hpp"
#include "actors/executor/plan/flight_plan.hpp"
#include "actors/executor/plan/plan_error.hpp"
#include "actors/executor/plan/straight_return.hpp"
#include "io/fields/field_table.hpp"
#include "io/mavlink/enums/vehicle.hpp"
#include "messages/flight/vehicle_class.hpp"
#include "messages/mission/document.hpp"
#include "messages/mission_client/types.hpp"
#include "messages/vehicle_link/connection.hpp"

namespace godwit::executor::preflight {

// The autopilot's own checks before arming.
enum class own_checks {
  unknown,  // it was not heard yet
  not_told, // it was heard, and does not say
  failing,
  passing
};

// Whether its estimator knows where on the earth it is.
enum class estimate {
  unknown,  // it was not heard yet, and may still be told
  not_told, // the vehicle does not say
  not_ready,
  ready
};

struct vehicle_facts {
  vehicle_link::connection_phase link = vehicle_link::connection_phase::down;
  std::string link_reason; // of that phase
  vehicle_link::line_findings line = {};
  flight::vehicle_class what = flight::vehicle_class::unknown;
  io::mavlink::mav_autopilot autopilot = io::mavlink::mav_autopilot::invalid; // from the air: may have no name
  io::mavlink::gps_fix_type fix = io::mavlink::gps_fix_type::no_gps;          // the same
  std::optional<std::uint8_t> satellites;                                     // absent: the receiver does not count
  std::optional<std::int64_t> position_age_ns;                                // absent: never heard
  bool is_home_known = false;
  bool is_moving = false;                      // in the air or driving, and godwit has not started it
  bool stands_ready_to_move = false;           // armed, in a mode in which it goes off by itself: the same
  std::optional<std::int32_t> battery_percent; // absent: not heard; -1: the autopilot does not know
  own_checks own = own_checks::unknown;
  preflight::estimate estimate = preflight::estimate::unknown;
  std::string why_not_armed; // in the vehicle's own words, of a moment ago; empty: it says nothing
};

// The home for which the mission was planned, as seen from the vehicle's.
struct planned_home_fact {
  double away_m = 0;
  double bearing_deg = 0;
};

using plan_result = tl::expected<std::vector<plan::flight_plan>, plan::plan_error>;

struct mission_facts {
  const mission::document* document = nullptr;              // its rules were looked at when it was read
  std::string refusal;                                      // why there is none; empty: none was asked for
  bool is_deleted = false;                                  // by the service, and so not flown any more
  const plan_result* plans = nullptr;                       // of this document; null: not planned yet
  std::optional<std::vector<plan::violation>> way;          // of all plans; absent: not looked at yet
  std::optional<double> spare_percent;                      // of the battery, after the first plan and the way home
  std::optional<std::vector<plan::violation>> return_point; // absent: not looked at yet
  std::optional<std::vector<std::string>> out_of_limits;    // a sentence for each item; absent: not looked at yet
  std::optional<planned_home_fact> planned_home;            // absent: there is none, or it was not looked at yet
  // Of all plans; absent: not looked at yet.
  std::optional<std::vector<plan::return_crossing>> straight_return;
  bool is_brought = false; // its first plan is on the vehicle
  bool has_service = true; // false: a ground station's; nothing keeps a map of it
  mission_client::pull_state map = mission_client::pull_state::not_started;
  std::string map_problem; // why the pull failed
};

struct journal_facts {
  bool is_writable = false;                // the last write reached the disk
  bool is_sound = false;                   // the integrity check passed
  bool is_nearly_full = false;             // what waits to be written is near its bound: the disk is too slow
  std::optional<std::uint64_t> free_bytes; // of its disk; absent: the system does not tell
  GODWIT_FIELDS(journal_facts, "executor.journal_facts", is_writable, is_sound, is_nearly_full, free_bytes);
};

struct operator_fact {
  bool is_there = false; // somebody who may fly: logged in or at the control socket, and heard just now
  GODWIT_FIELDS(operator_fact, "executor.operator_fact", is_there);
};

struct actor_fact {
  std::string name;
  bool is_running = false;
};

struct program_fact {
  bool is_exchanged = false; // on the disk lies another one: a crash would start that
  GODWIT_FIELDS(program_fact, "executor.program_fact", is_exchanged);
};

enum class camera_state { unknown, off, not_ready, ready };

GODWIT_ENUM_NAMES(camera_state, unknown, off, not_ready, ready);

struct camera_fact {
  camera_state state = camera_state::off;
  std::string problem; // why it is not ready, as a sentence without its end; empty: not known
  GODWIT_FIELDS(camera_fact, "executor.camera_fact", state, problem);
};

// Sentences about other aircraft.
struct traffic_facts {
  std::vector<std::string> heard; // the nearest first
  std::vector<std::string> close; // of these
};

struct facts {
  vehicle_facts vehicle;
  mission_facts mission;
  journal_facts journal;
  std::int64_t wall_ns = 0;
  bool is_operator_session_alive = false;
  std::vector<actor_fact> actors; // all that have to run
  program_fact program;
  camera_fact camera{camera_state::unknown, {}};
  traffic_facts traffic;
};

// While it is not, nothing that is known of the vehicle counts; the check of the link fails then.
[[nodiscard]] inline bool is_vehicle_heard(const facts& seen) {
  return seen.vehicle.link == vehicle_link::connection_phase::connected;
}

// The end of a sentence about what keeps the vehicle from being armed.
[[nodiscard]] inline std::string in_its_words(const facts& seen) {
  return seen.vehicle.why_not_armed.empty() ? "" : " It reports: " + seen.vehicle.why_not_armed;
}

} // namespace godwit::executor::preflight
