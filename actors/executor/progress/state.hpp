// What of the progress must survive a crash: everything that a decision depends on.
//
//                     upload accepted, or          MISSION_CURRENT: our plan,
//                     start accepted               the expected sequence
//        no plan ─────────────────────> opened ───────────────────────> armed ──> finished
//                                        ^  ^                             │ │        │
//                                        │  └── next upload or start ─────┘ │        │
//                                        └──────────────────────────────────┼────────┘
//                                        ^                                  v
//                                        └── next upload or start ─────── paused (foreign plan, vehicle restarted,
//                                                                                 aborted)
//
// A generation is what one accepted upload or start begins, or one more round of a loop. Progress counts in an armed
// generation only; all that is told before it is armed, or after the next one is opened, changes nothing. Sequences are
// the vehicle's, positions those in the items of the map, times nanoseconds since 1970 (UTC). Thread: plain values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "actors/executor/progress/events.hpp"
#include "actors/executor/progress/plan_map.hpp"
#include "io/fields/field_table.hpp"
#include "io/mavlink/messages/mission.hpp"
#include "messages/mission/progress.hpp"

namespace godwit::executor::progress {

// A line that is not flown to its end: the way to the item, where the last picture was taken on it, and all of them.
struct begun_line {
  std::string item_id;
  mission::vertex at;
  mission::picture_count pictures;
  GODWIT_FIELDS(begun_line, "executor.progress_begun_line", item_id, at, pictures);
};

// One mission, also when others were flown in between.
struct mission_record {
  std::string mission_id;
  std::int32_t revision = 1;                           // of the plan that is followed
  std::uint32_t report_no = 0;                         // of the last report
  std::optional<mission::progress_report> last_report; // what the answer to an assignment tells
  std::optional<std::int32_t> completed_revision;      // complete is reported once for each
  std::vector<taken_jump> jumps = {};                  // those that were taken; max_mapped_items, then the oldest goes
  std::optional<begun_line> line = {};                 // also while the plan on the vehicle leads elsewhere
  GODWIT_FIELDS(mission_record, "executor.progress_mission_record", mission_id, revision, report_no, last_report,
                completed_revision, jumps, line);
};

// An act of which it is known what became of it, before the vehicle has gone on from it.
struct resolved_act {
  std::uint32_t position = 0;
  mission::act_outcome outcome = mission::act_outcome::confirmed;
  std::optional<std::int32_t> picture = {}; // its number
  GODWIT_FIELDS(resolved_act, "executor.progress_resolved_act", position, outcome, picture);
};

// A picture that came just before the vehicle reported that it is where one is to be taken.
struct early_picture {
  std::int32_t index = 0;
  std::uint32_t count = 1; // with those before it that nobody heard
  std::int64_t at_ns = 0;
  GODWIT_FIELDS(early_picture, "executor.progress_early_picture", index, count, at_ns);
};

enum class generation_origin {
  new_plan,
  same_plan, // with the content of the one before: the vehicle may just go on in it
  start,
  round // a jump has led the vehicle back
};

GODWIT_ENUM_NAMES(generation_origin, new_plan, same_plan, start, round);

struct generation_state {
  std::uint32_t number = 0;
  generation_origin origin = generation_origin::new_plan;
  std::uint16_t start_sequence = 0;
  std::int64_t resolving_since_ns = 0; // its opening, or when it was armed if that came later than settling_ns
  bool is_armed = false;
  bool is_active = false;   // the vehicle said last that it flies it
  bool is_complete = false; // the vehicle said last that it has completed the mission
  bool was_active = false;  // or incomplete before its start: a MISSION_STATE complete is not an older one
  bool is_finished = false; // all items that move the vehicle are done
  bool was_beyond = true;   // the vehicle, when it was started: where it is now may be where it was then
  bool is_found = false;    // somebody has started it, perhaps not godwit: it is not sent back to its start
  std::optional<start_intended> tried_start = {}; // that has failed: it may have been obeyed unheard
  bool is_not_at_start_told = false;              // once is enough
  std::uint16_t current = 0;                      // of an armed one: where the vehicle is
  // What waits a moment for the MISSION_ITEM_REACHED of the item just left: the vehicle has moved on to here, or has
  // completed the mission with all up to here flown.
  std::optional<std::uint16_t> moved_to;
  std::optional<std::uint16_t> complete_upto;
  std::int64_t waiting_since_ns = 0;
  // Where the plan has loops: the vehicle was last heard no longer than a part of a round after this.
  std::int64_t heard_ns = 0;
  // A vehicle with plan ids (PX4) repeats the last MISSION_ITEM_REACHED, and goes on with that after a start which
  // changes nothing for it: this one is no news until another one was told.
  std::optional<std::uint16_t> stale_reached;
  std::vector<std::uint16_t> never_near;         // places that the track contradicts: their items were not reached
  std::uint32_t resolved = 0;                    // so many items from the front are done or skipped
  std::optional<std::uint32_t> started_position; // the last item that was reported as started
  std::vector<resolved_act> acts = {};           // of items that are not resolved; one for each
  mission::picture_count pictures = {};          // since the last item that moves the vehicle was resolved
  mission::picture_count next_pictures = {};     // on the way that follows: the vehicle has moved on to it
  bool is_reached = false;                 // the item where it is, which is not resolved: its last picture is awaited
  std::optional<early_picture> early = {}; // not counted in `pictures` yet
  static constexpr auto fields = io::table(
      "executor.progress_generation_state", io::field("number", &generation_state::number),
      io::field("start_sequence", &generation_state::start_sequence), io::field("origin", &generation_state::origin),
      io::field("settling_since_ns", &generation_state::resolving_since_ns),
      io::field("is_armed", &generation_state::is_armed), io::field("is_active", &generation_state::is_active),
      io::field("is_complete", &generation_state::is_complete), io::field("was_active", &generation_state::was_active),
      io::field("is_finished", &generation_state::is_finished), io::field("was_beyond", &generation_state::was_beyond),
      io::field("is_found", &generation_state::is_found), io::field("tried_start", &generation_state::tried_start),
      io::field("is_not_at_start_told", &generation_state::is_not_at_start_told),
      io::field("current", &generation_state::current), io::field("moved_to", &generation_state::moved_to),
      io::field("complete_upto", &generation_state::complete_upto),
      io::field("waiting_since_ns", &generation_state::waiting_since_ns),
      io::field("heard_ns", &generation_state::heard_ns), io::field("stale_reached", &generation_state::stale_reached),
      io::field("never_near", &generation_state::never_near), io::field("settled", &generation_state::resolved),
      io::field("started_position", &generation_state::started_position), io::field("acts", &generation_state::acts),
      io::field("pictures", &generation_state::pictures), io::field("next_pictures", &generation_state::next_pictures),
      io::field("is_reached", &generation_state::is_reached), io::field("early", &generation_state::early));
};

struct followed_plan {
  plan_map map;
  std::optional<std::uint32_t> vehicle_plan_id; // absent: the vehicle keeps none, or has not told it yet
  std::optional<std::uint32_t> id_before;       // of the plan that was replaced
  std::optional<std::uint16_t> last_reached;    // as told last, whether it counted or not
  std::uint32_t ever_resolved = 0;              // the most that any generation of this plan has resolved
  generation_state generation;
  static constexpr auto fields = io::table(
      "executor.progress_followed_plan", io::field("map", &followed_plan::map),
      io::field("vehicle_plan_id", &followed_plan::vehicle_plan_id), io::field("id_before", &followed_plan::id_before),
      io::field("last_reached", &followed_plan::last_reached), io::field("ever_settled", &followed_plan::ever_resolved),
      io::field("generation", &followed_plan::generation));
};

struct pending_upload {
  std::uint32_t generation = 0; // the one that it will open
  upload_intended intent;
  std::optional<std::uint32_t> id_seen; // by the look that was to resolve it
  // REACHED does not say of which plan. It counts when the next MISSION_CURRENT still has the old id.
  std::optional<std::uint16_t> unconfirmed_reached;
  GODWIT_FIELDS(pending_upload, "executor.progress_pending_upload", generation, intent, id_seen, unconfirmed_reached);
};

enum class pause_reason { foreign_plan, vehicle_restarted, aborted, infeasible_plan };

GODWIT_ENUM_NAMES(pause_reason, foreign_plan, vehicle_restarted, aborted, infeasible_plan);

inline constexpr std::size_t max_held = 8;           // a new one is dropped then: the vehicle repeats itself
inline constexpr std::size_t max_past_missions = 32; // the oldest is forgotten; flown again, it counts from 1

struct state {
  std::optional<mission_record> mission;
  std::vector<mission_record> past_missions; // oldest first
  std::uint32_t last_generation = 0;
  std::optional<followed_plan> plan;
  std::optional<pending_upload> upload;
  std::optional<start_intended> start;
  // MISSION_CURRENT that may be of the plan or start under way, and is looked at when that is resolved. None twice.
  std::vector<io::mavlink::mission_current> held;
  std::uint64_t dropped_held = 0; // for which there was no room
  std::optional<pause_reason> paused;
  std::optional<std::int32_t> last_picture = {}; // its number; absent: none was ever reported
  bool is_unheard_told = false;                  // that no pictures are reported

  static constexpr int version = 1;
  GODWIT_FIELDS(state, "executor.progress_state", mission, past_missions, last_generation, plan, upload, start, held,
                dropped_held, paused, last_picture, is_unheard_told);
};

} // namespace godwit::executor::progress
