// What has happened to the points of interest and to the passes, as the journal keeps it. A fact is put into the state
// and decides nothing. `at_ns` is monotonic. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "actors/scan_controller/point.hpp"
#include "io/fields/field_table.hpp"
#include "messages/mapobjects_store/pass.hpp"

namespace godwit::scan_controller {

// A pass: all lines of a survey, flown one after the other with nothing in between. Only of a whole one the map is told
// what was in view. Thread: plain values.
//
//   none ──on the way to line 1──> open ──last line──> complete: owed to the map, told when sightings have settled
//                                   └──held, taken over, replanned, a line left out, another process──> lost
struct open_pass {
  std::string mission_id;
  std::string item_id; // of the survey
  std::uint32_t generation = 0;
  std::uint32_t lines = 0;
  std::uint32_t lines_done = 0;
  std::uint64_t process = 0;        // another one has not seen all of it
  std::int64_t started_wall_ns = 0; // as the sightings are dated
  bool is_over = false;             // lost or complete: the rest of this survey is no pass
  GODWIT_FIELDS(open_pass, "scan_controller.open_pass", mission_id, item_id, generation, lines, lines_done, process,
                started_wall_ns, is_over);
};

struct owed_pass {
  mapobjects_store::pass_end what;
  std::int64_t due_ns = 0; // monotonic
  GODWIT_FIELDS(owed_pass, "scan_controller.owed_pass", what, due_ns);
};

// -- facts

struct pass_begun {
  open_pass what;
  GODWIT_FIELDS(pass_begun, "scan_controller.pass_begun", what);
};

struct pass_advanced {
  std::uint32_t lines_done = 0;
  GODWIT_FIELDS(pass_advanced, "scan_controller.pass_advanced", lines_done);
};

struct pass_lost {
  std::string why; // for people
  GODWIT_FIELDS(pass_lost, "scan_controller.pass_lost", why);
};

struct pass_completed {
  owed_pass owed;
  GODWIT_FIELDS(pass_completed, "scan_controller.pass_completed", owed);
};

struct pass_delivered {
  std::string id;
  GODWIT_FIELDS(pass_delivered, "scan_controller.pass_delivered", id);
};

// The computer was started anew: its monotonic clock is behind by so much.
struct clock_restarted {
  std::int64_t behind_ns = 0;
  GODWIT_FIELDS(clock_restarted, "scan_controller.clock_restarted", behind_ns);
};

// All points are of this one from now on; the others are dropped, or passed over where they were shown.
struct mission_begun {
  std::string mission_id;
  std::int64_t at_ns = 0;
  GODWIT_FIELDS(mission_begun, "scan_controller.mission_begun", mission_id, at_ns);
};

struct point_opened {
  point what;
  std::uint64_t again = 0; // number of the one that was passed over and is forgotten for it; 0: none
  std::int64_t at_ns = 0;
  GODWIT_FIELDS(point_opened, "scan_controller.point_opened", what, again, at_ns);
};

// Seen again.
struct point_seen {
  point now; // as it is with the new sighting; its number says which
  std::int64_t at_ns = 0;
  GODWIT_FIELDS(point_seen, "scan_controller.point_seen", now, at_ns);
};

struct point_dropped {
  std::uint64_t number = 0; // 0: it was dropped as it came
  drop_reason why = drop_reason::too_old;
  std::int64_t at_ns = 0;
  GODWIT_FIELDS(point_dropped, "scan_controller.point_dropped", number, why, at_ns);
};

struct showing_begun {
  std::uint64_t number = 0;
  std::int64_t window_ms = 0;
  std::uint32_t most_a_minute = 0;
  std::int64_t at_ns = 0;
  GODWIT_FIELDS(showing_begun, "scan_controller.showing_begun", number, window_ms, most_a_minute, at_ns);
};

// A person has decided, or the window is over.
struct showing_ended {
  std::uint64_t number = 0;
  point_outcome outcome = point_outcome::passed_over;
  std::string by;
  std::int64_t at_ns = 0;
  std::int64_t wall_ns = 0; // for the map
  GODWIT_FIELDS(showing_ended, "scan_controller.showing_ended", number, outcome, by, at_ns, wall_ns);
};

// The map has taken the oldest decision that was owed to it, or will never take it.
struct verdict_delivered {
  std::string id;
  GODWIT_FIELDS(verdict_delivered, "scan_controller.verdict_delivered", id);
};

using fact =
    std::variant<clock_restarted, mission_begun, point_opened, point_seen, point_dropped, showing_begun, showing_ended,
                 verdict_delivered, pass_begun, pass_advanced, pass_lost, pass_completed, pass_delivered>;

} // namespace godwit::scan_controller
