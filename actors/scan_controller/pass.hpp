// A pass: all lines of a survey, flown one after the other with nothing in between. Only of a whole one the map is told
// what was in view. Thread: plain values.
//
//   none ──on the way to line 1──> open ──last line──> complete: owed to the map, told when sightings have settled
//                                   └──held, taken over, replanned, a line left out, another process──> lost
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "io/fields/field_table.hpp"
#include "messages/mapobjects_store/pass.hpp"

namespace godwit::scan_controller {

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

} // namespace godwit::scan_controller
