// Points of interest as people see them. Numbers rise from 1 and are never given twice. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/mapobjects_store/object.hpp"

namespace godwit::scan_controller {

enum class point_outcome {
  confirmed,
  declined,   // of no interest: the map ignores such things there from now on
  passed_over // nobody decided in time
};

GODWIT_ENUM_NAMES(point_outcome, confirmed, declined, passed_over);

// Told to subscribers: a person may decide from now on.
struct point_shown {
  std::uint64_t number = 0;
  std::string mission_id;
  std::string class_group;
  mapobjects_store::geo_position position;
  double confidence = 0; // 0..1
  bool has_moved = false;
  std::int64_t shown_ns = 0;       // monotonic
  std::int64_t window_ms = 0;      // for so long
  std::uint32_t most_a_minute = 0; // points shown in any 60 s, as it was set
  GODWIT_FIELDS(point_shown, "scan_controller.point_shown", number, mission_id, class_group, position, confidence,
                has_moved, shown_ns, window_ms, most_a_minute);
};

// Told to subscribers: nobody can decide about it any more.
struct point_closed {
  std::uint64_t number = 0;
  std::string mission_id;
  point_outcome outcome = point_outcome::passed_over;
  std::string by; // who decided; empty: nobody
  GODWIT_FIELDS(point_closed, "scan_controller.point_closed", number, mission_id, outcome, by);
};

// What became of all points since the journal began. Those that wait or are shown are in none but `opened`.
struct point_counts {
  std::uint64_t opened = 0; // also what was dropped as it came
  std::uint64_t confirmed = 0;
  std::uint64_t declined = 0;
  std::uint64_t passed_over = 0;
  std::uint64_t too_faint = 0;    // dropped: they waited too long below the threshold
  std::uint64_t too_old = 0;      // dropped: they waited too long for their turn, or came late
  std::uint64_t no_room = 0;      // dropped: others were worth more
  std::uint64_t mission_over = 0; // dropped: another mission began
  GODWIT_FIELDS(point_counts, "scan_controller.point_counts", opened, confirmed, declined, passed_over, too_faint,
                too_old, no_room, mission_over);
};

// Answered with points, as they are on the disk.
struct get_points {
  static constexpr auto fields = io::table("scan_controller.get_points");
};

struct point_view {
  std::uint64_t number = 0;
  std::string class_group;
  mapobjects_store::geo_position position;
  double confidence = 0;
  bool has_moved = false;
  std::int64_t seen_ago_ms = 0;      // the newest sighting
  std::int64_t decide_within_ms = 0; // of one that is shown
  std::string by;                    // of one that is confirmed: who did
  GODWIT_FIELDS(point_view, "scan_controller.point_view", number, class_group, position, confidence, has_moved,
                seen_ago_ms, decide_within_ms, by);
};

struct points {
  std::string mission_id; // of all of them; empty: there was none yet
  std::vector<point_view> shown;
  std::vector<point_view> confirmed; // of this mission, as far as they are remembered
  std::uint32_t waiting = 0;
  point_counts counts;
  GODWIT_FIELDS(points, "scan_controller.points", mission_id, shown, confirmed, waiting, counts);
};

// Something that may be worth a look, from whoever recognises things. Thread: plain values.

// Answered with candidate_answer when what comes of it is on the disk. Who hears no answer says it again: it counts
// once.
struct candidate {
  std::string id; // UUID of the sighting
  std::string mission_id;
  std::optional<std::string> object_id; // on the map
  std::string class_group;
  mapobjects_store::geo_position position;
  std::int64_t at_ns = 0; // when it was seen, since 1970 (UTC)
  double confidence = 0;  // 0..1
  bool has_moved = false; // a known object, away from its place
  bool is_known = false;  // a known object at its place: counts only for a point that is there already
  GODWIT_FIELDS(candidate, "scan_controller.candidate", id, mission_id, object_id, class_group, position, at_ns,
                confidence, has_moved, is_known);
};

enum class candidate_fate {
  opened,   // a new point of interest
  merged,   // into one that waits or is shown
  resolved, // of a point that was decided, or passed over a short while ago
  known,    // at its place, and no point
  too_old,  // seen too long ago
  no_room   // all points that wait are worth more
};

GODWIT_ENUM_NAMES(candidate_fate, opened, merged, resolved, known, too_old, no_room);

struct candidate_answer {
  candidate_fate fate = candidate_fate::known;
  std::uint64_t point = 0; // its number; 0: none
  GODWIT_FIELDS(candidate_answer, "scan_controller.candidate_answer", fate, point);
};

// What a person says of a point of interest. Thread: plain values.
enum class decision { confirm, decline };

GODWIT_ENUM_NAMES(decision, confirm, decline);

// Of a point that is shown. Whoever passes it on has authenticated the person. Answered with decide_answer when it is
// on the disk; said again, it is answered as the first time.
struct decide_point {
  std::uint64_t number = 0;
  decision says = decision::decline;
  std::string by;
  GODWIT_FIELDS(decide_point, "scan_controller.decide_point", number, says, by);
};

struct decide_answer {
  bool is_taken = false;
  std::string reason; // sentence for people; empty when taken
  GODWIT_FIELDS(decide_answer, "scan_controller.decide_answer", is_taken, reason);
};

} // namespace godwit::scan_controller
