// Points of interest as people see them. Numbers rise from 1 and are never given twice. Thread: plain values.
#pragma once

#include <cstdint>
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

} // namespace godwit::scan_controller
