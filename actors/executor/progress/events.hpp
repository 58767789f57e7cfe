// All that changes the progress of a mission: what the executor decides and learns, and what the vehicle says.
//
// The intents are told before the vehicle is: an intent that is on the disk is what a restart has to resolve. At most
// one intent is under way at a time. Events from the vehicle are told as they come, late and repeated ones too. Thread:
// plain values. Source: MISSION_CURRENT (42), MISSION_ITEM_REACHED (46), MISSION_ACK (47), STATUSTEXT (253),
// CAMERA_FEEDBACK (180), CAMERA_IMAGE_CAPTURED (263).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "actors/executor/progress/plan_map.hpp"
#include "io/fields/field_table.hpp"
#include "io/mavlink/messages/mission.hpp"
#include "messages/mission/place.hpp"
#include "messages/mission/progress.hpp"

namespace godwit::executor::progress {

// -- the executor decides ---------------------------------------------------------------------------

// From now on it is this mission. Again for the one that is open: nothing changes. No intent may be under way.
struct mission_opened {
  std::string mission_id; // UUID
  std::int32_t revision = 1;
  GODWIT_FIELDS(mission_opened, "executor.progress_mission_opened", mission_id, revision);
};

// The service's assignment that a plan executes, and the key of the answer, made before its first try.
struct assignment_key {
  std::string assignment_id;
  std::string idempotency_key;
  GODWIT_FIELDS(assignment_key, "executor.progress_assignment_key", assignment_id, idempotency_key);
  friend bool operator==(const assignment_key&, const assignment_key&) = default;
};

// A plan for the open mission is about to go to the vehicle: told before MISSION_COUNT. A vehicle without plan ids is
// held by then, since MISSION_COUNT cuts the mission that it flies.
struct upload_intended {
  std::int32_t revision = 1;
  plan_map map;
  std::optional<std::uint32_t> id_before; // what the vehicle holds now; absent: nothing, or it keeps no ids
  std::optional<assignment_key> assignment;
  GODWIT_FIELDS(upload_intended, "executor.progress_upload_intended", revision, map, id_before, assignment);
};

// A MISSION_START or a set-current is about to go to the vehicle, which will begin there.
struct start_intended {
  std::uint16_t sequence = 0;
  bool was_incomplete = false; // its MISSION_STATE before: one that is complete after this is not an older one
  bool was_beyond = true;      // its MISSION_CURRENT before, as far as it is known
  GODWIT_FIELDS(start_intended, "executor.progress_start_intended", sequence, was_incomplete, was_beyond);
};

// The missions service has more reports of a mission than we know of: numbers and generations go on after them.
struct earlier_reports_told {
  std::string mission_id;
  std::uint32_t last_report_no = 0;
  std::optional<mission::progress_report> last_report; // absent: it does not give it back
  GODWIT_FIELDS(earlier_reports_told, "executor.progress_earlier_reports_told", mission_id, last_report_no,
                last_report);
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

GODWIT_ENUM_NAMES(upload_verdict, accepted, unchanged, other, infeasible, unknown);

struct upload_ended {
  upload_verdict verdict = upload_verdict::unknown;
  std::optional<std::uint32_t> plan_id; // the vehicle's for the new plan, where it keeps one
  std::string reason;                   // sentence for people; empty when accepted
  bool has_no_room = false;             // the vehicle, for so long a plan
  GODWIT_FIELDS(upload_ended, "executor.progress_upload_ended", verdict, plan_id, reason, has_no_room);
};

// The answer to look_at_vehicle. Told when no transfer is under way any more: one that goes on would make it untrue.
struct vehicle_looked_at {
  std::optional<std::uint32_t> plan_id; // absent: none, or it keeps no ids
  bool is_tried_again = false;          // where the plan did not come nobody is told that the upload failed
  GODWIT_FIELDS(vehicle_looked_at, "executor.progress_vehicle_looked_at", plan_id, is_tried_again);
};

enum class read_back_match {
  pending, // what was to be uploaded, by meaning; also when that is what it held before
  before,  // what the vehicle held before
  other
};

GODWIT_ENUM_NAMES(read_back_match, pending, before, other);

// The answer to read_plan_back.
struct plan_read_back {
  read_back_match match = read_back_match::other;
  bool is_tried_again = false; // as in vehicle_looked_at
  GODWIT_FIELDS(plan_read_back, "executor.progress_plan_read_back", match, is_tried_again);
};

// The vehicle flies the plan, and nobody here has started it: it counts from this item on.
struct found_begun {
  std::uint16_t sequence = 0;
  bool was_incomplete = false; // as above
  GODWIT_FIELDS(found_begun, "executor.progress_found_begun", sequence, was_incomplete);
};

// What became of the command: whether the vehicle has begun where start_intended said.
struct start_ended {
  bool is_accepted = false;
  GODWIT_FIELDS(start_ended, "executor.progress_start_ended", is_accepted);
};

// -- the vehicle says -------------------------------------------------------------------------------

struct current_told {
  io::mavlink::mission_current message;
  bool is_disarmed = false; // the vehicle flies nothing, whatever its mode (PX4 lands and stays in that of its mission)
  bool is_ours = true;      // godwit has the vehicle; what it does under anybody else is no progress of the mission
  std::vector<std::uint16_t> never_near = {}; // places of the plan that the track contradicts: not reached
  GODWIT_FIELDS(current_told, "executor.progress_current_told", message, is_disarmed, is_ours, never_near);
};

struct reached_told {
  std::uint16_t sequence = 0;
  std::vector<std::uint16_t> never_near = {}; // as in current_told
  GODWIT_FIELDS(reached_told, "executor.progress_reached_told", sequence, never_near);
};

// By a text of the vehicle.
struct act_told {
  act_kind act = act_kind::none;
  mission::act_outcome outcome = mission::act_outcome::confirmed;
  std::string text; // as it came
  GODWIT_FIELDS(act_told, "executor.progress_act_told", act, outcome, text);
};

struct picture_told {
  std::int32_t index = 0; // as the camera counts
  bool is_good = true;
  std::optional<mission::vertex> at = {}; // where it was taken, as far as it is known
  GODWIT_FIELDS(picture_told, "executor.progress_picture_told", index, is_good, at);
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
                           reached_told, act_told, picture_told, came_down, other_plan_found, vehicle_rebooted>;

} // namespace godwit::executor::progress
