// All that changes the progress of a mission: what the executor decides and learns, and what the vehicle says.
//
// The intents are told before the vehicle is: an intent that is on the disk is what a restart has to resolve. At most
// one intent is under way at a time. Events from the vehicle are told as they come, late and repeated ones too. Thread:
// plain values. Source: MISSION_CURRENT (42), MISSION_ITEM_REACHED (46), MISSION_ACK (47).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "actors/executor/progress/plan_map.hpp"
#include "io/fields/field_table.hpp"
#include "io/mavlink/messages/mission.hpp"
#include "messages/mission/progress.hpp"

namespace godwit::executor::progress {

// -- the executor decides ---------------------------------------------------------------------------

// From now on it is this mission. Again for the one that is open: nothing changes. No intent may be under way.
struct mission_opened {
  std::string mission_id; // UUID
  std::int32_t revision = 1;
  static constexpr auto fields =
      io::table("executor.progress_mission_opened", io::field("mission_id", &mission_opened::mission_id),
                io::field("revision", &mission_opened::revision));
};

// The service's assignment that a plan carries out, and the key of the answer, made before its first try.
struct assignment_key {
  std::string assignment_id;
  std::string idempotency_key;
  static constexpr auto fields =
      io::table("executor.progress_assignment_key", io::field("assignment_id", &assignment_key::assignment_id),
                io::field("idempotency_key", &assignment_key::idempotency_key));
  friend bool operator==(const assignment_key&, const assignment_key&) = default;
};

// A plan for the open mission is about to go to the vehicle: told before MISSION_COUNT. A vehicle without plan ids is
// held by then, since MISSION_COUNT cuts the mission that it flies.
struct upload_intended {
  std::int32_t revision = 1;
  plan_map map;
  std::optional<std::uint32_t> id_before; // what the vehicle holds now; absent: nothing, or it keeps no ids
  std::optional<assignment_key> assignment;
  static constexpr auto fields =
      io::table("executor.progress_upload_intended", io::field("revision", &upload_intended::revision),
                io::field("map", &upload_intended::map), io::field("id_before", &upload_intended::id_before),
                io::field("assignment", &upload_intended::assignment));
};

// A MISSION_START or a set-current is about to go to the vehicle, which will begin there.
struct start_intended {
  std::uint16_t sequence = 0;
  static constexpr auto fields =
      io::table("executor.progress_start_intended", io::field("sequence", &start_intended::sequence));
};

// The missions service has more reports of a mission than we know of: numbers and generations go on behind them.
struct earlier_reports_told {
  std::string mission_id;
  std::uint32_t last_report_no = 0;
  std::optional<mission::progress_report> last_report; // absent: it does not give it back
  static constexpr auto fields =
      io::table("executor.progress_earlier_reports_told", io::field("mission_id", &earlier_reports_told::mission_id),
                io::field("last_report_no", &earlier_reports_told::last_report_no),
                io::field("last_report", &earlier_reports_told::last_report));
};

// The mission ends here.
struct mission_aborted {
  static constexpr auto fields = io::table("executor.progress_mission_aborted");
};

// -- the executor learns ----------------------------------------------------------------------------

enum class upload_verdict {
  accepted,   // with a proof: the vehicle holds the plan
  unchanged,  // the vehicle holds what it held before
  other,      // the vehicle was looked at, and holds neither
  infeasible, // it holds the plan, and finds that it can not be flown
  unknown     // it has to be looked at
};

constexpr auto enum_names(upload_verdict) {
  return io::names<upload_verdict>({{upload_verdict::accepted, "accepted"},
                                    {upload_verdict::unchanged, "unchanged"},
                                    {upload_verdict::other, "other"},
                                    {upload_verdict::infeasible, "infeasible"},
                                    {upload_verdict::unknown, "unknown"}});
}

struct upload_ended {
  upload_verdict verdict = upload_verdict::unknown;
  std::optional<std::uint32_t> plan_id; // the vehicle's for the new plan, where it keeps one
  std::string reason;                   // sentence for people; empty when accepted
  bool has_no_room = false;             // the vehicle, for so long a plan
  static constexpr auto fields =
      io::table("executor.progress_upload_ended", io::field("verdict", &upload_ended::verdict),
                io::field("plan_id", &upload_ended::plan_id), io::field("reason", &upload_ended::reason),
                io::field("has_no_room", &upload_ended::has_no_room));
};

// The answer to look_at_vehicle. Told when no transfer is under way any more: one that goes on would make it untrue.
struct vehicle_looked_at {
  std::optional<std::uint32_t> plan_id; // absent: none, or it keeps no ids
  bool is_tried_again = false;          // where the plan did not come nobody is told that the upload failed
  static constexpr auto fields =
      io::table("executor.progress_vehicle_looked_at", io::field("plan_id", &vehicle_looked_at::plan_id),
                io::field("is_tried_again", &vehicle_looked_at::is_tried_again));
};

enum class read_back_match {
  pending, // what was to be uploaded, by meaning; also when that is what it held before
  before,  // what the vehicle held before
  other
};

constexpr auto enum_names(read_back_match) {
  return io::names<read_back_match>(
      {{read_back_match::pending, "pending"}, {read_back_match::before, "before"}, {read_back_match::other, "other"}});
}

// The answer to read_plan_back.
struct plan_read_back {
  read_back_match match = read_back_match::other;
  bool is_tried_again = false; // as in vehicle_looked_at
  static constexpr auto fields =
      io::table("executor.progress_plan_read_back", io::field("match", &plan_read_back::match),
                io::field("is_tried_again", &plan_read_back::is_tried_again));
};

// The vehicle flies the plan, and nobody here has started it: it counts from this item on.
struct found_begun {
  std::uint16_t sequence = 0;
  static constexpr auto fields =
      io::table("executor.progress_found_begun", io::field("sequence", &found_begun::sequence));
};

// What became of the command: whether the vehicle has begun where start_intended said.
struct start_ended {
  bool is_accepted = false;
  static constexpr auto fields =
      io::table("executor.progress_start_ended", io::field("is_accepted", &start_ended::is_accepted));
};

// -- the vehicle says -------------------------------------------------------------------------------

struct current_told {
  io::mavlink::mission_current message;
  bool is_disarmed = false; // the vehicle flies nothing, whatever its mode (PX4 lands and stays in that of its mission)
  bool is_ours = true;      // godwit has the vehicle; what it does under anybody else is no progress of the mission
  std::vector<std::uint16_t> never_near = {}; // places of the plan that the track contradicts: not reached
  static constexpr auto fields =
      io::table("executor.progress_current_told", io::field("message", &current_told::message),
                io::field("is_disarmed", &current_told::is_disarmed), io::field("is_ours", &current_told::is_ours),
                io::field("never_near", &current_told::never_near));
};

struct reached_told {
  std::uint16_t sequence = 0;
  std::vector<std::uint16_t> never_near = {}; // as in current_told
  static constexpr auto fields =
      io::table("executor.progress_reached_told", io::field("sequence", &reached_told::sequence),
                io::field("never_near", &reached_told::never_near));
};

// It stands on the ground, disarmed, and nobody has taken it from its mission: a plan that ends with a landing or a
// return has brought it there. ArduPilot's Copter lands, disarms and sets its mission back to the first item without a
// word that it was done; PX4 leaves its mission mode for the return.
struct came_down {
  static constexpr auto fields = io::table("executor.progress_came_down");
};

// It was read, and holds a plan that is not the one that was brought to it.
struct other_plan_found {
  static constexpr auto fields = io::table("executor.progress_other_plan_found");
};

// Its clock since boot went back.
struct vehicle_rebooted {
  static constexpr auto fields = io::table("executor.progress_vehicle_rebooted");
};

using event = std::variant<mission_opened, earlier_reports_told, upload_intended, start_intended, mission_aborted,
                           upload_ended, vehicle_looked_at, plan_read_back, found_begun, start_ended, current_told,
                           reached_told, came_down, other_plan_found, vehicle_rebooted>;

} // namespace godwit::executor::progress
