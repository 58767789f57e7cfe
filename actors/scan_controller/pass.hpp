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
  static constexpr auto fields =
      io::table("scan_controller.open_pass", io::field("mission_id", &open_pass::mission_id),
                io::field("item_id", &open_pass::item_id), io::field("generation", &open_pass::generation),
                io::field("lines", &open_pass::lines), io::field("lines_done", &open_pass::lines_done),
                io::field("process", &open_pass::process), io::field("started_wall_ns", &open_pass::started_wall_ns),
                io::field("is_over", &open_pass::is_over));
};

struct owed_pass {
  mapobjects_store::pass_end what;
  std::int64_t due_ns = 0; // monotonic
  static constexpr auto fields = io::table("scan_controller.owed_pass", io::field("what", &owed_pass::what),
                                           io::field("due_ns", &owed_pass::due_ns));
};

// -- facts

struct pass_begun {
  open_pass what;
  static constexpr auto fields = io::table("scan_controller.pass_begun", io::field("what", &pass_begun::what));
};

struct pass_advanced {
  std::uint32_t lines_done = 0;
  static constexpr auto fields =
      io::table("scan_controller.pass_advanced", io::field("lines_done", &pass_advanced::lines_done));
};

struct pass_lost {
  std::string why; // for people
  static constexpr auto fields = io::table("scan_controller.pass_lost", io::field("why", &pass_lost::why));
};

struct pass_completed {
  owed_pass owed;
  static constexpr auto fields = io::table("scan_controller.pass_completed", io::field("owed", &pass_completed::owed));
};

struct pass_delivered {
  std::string id;
  static constexpr auto fields = io::table("scan_controller.pass_delivered", io::field("id", &pass_delivered::id));
};

} // namespace godwit::scan_controller
