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

constexpr auto enum_names(point_outcome) {
  return io::names<point_outcome>({{point_outcome::confirmed, "confirmed"},
                                   {point_outcome::declined, "declined"},
                                   {point_outcome::passed_over, "passed_over"}});
}

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
  static constexpr auto fields = io::table(
      "scan_controller.point_shown", io::field("number", &point_shown::number),
      io::field("mission_id", &point_shown::mission_id), io::field("class_group", &point_shown::class_group),
      io::field("position", &point_shown::position), io::field("confidence", &point_shown::confidence),
      io::field("has_moved", &point_shown::has_moved), io::field("shown_ns", &point_shown::shown_ns),
      io::field("window_ms", &point_shown::window_ms), io::field("most_a_minute", &point_shown::most_a_minute));
};

// Told to subscribers: nobody can decide about it any more.
struct point_closed {
  std::uint64_t number = 0;
  std::string mission_id;
  point_outcome outcome = point_outcome::passed_over;
  std::string by; // who decided; empty: nobody
  static constexpr auto fields =
      io::table("scan_controller.point_closed", io::field("number", &point_closed::number),
                io::field("mission_id", &point_closed::mission_id), io::field("outcome", &point_closed::outcome),
                io::field("by", &point_closed::by));
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
  static constexpr auto fields =
      io::table("scan_controller.point_counts", io::field("opened", &point_counts::opened),
                io::field("confirmed", &point_counts::confirmed), io::field("declined", &point_counts::declined),
                io::field("passed_over", &point_counts::passed_over), io::field("too_faint", &point_counts::too_faint),
                io::field("too_old", &point_counts::too_old), io::field("no_room", &point_counts::no_room),
                io::field("mission_over", &point_counts::mission_over));
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
  static constexpr auto fields =
      io::table("scan_controller.point_view", io::field("number", &point_view::number),
                io::field("class_group", &point_view::class_group), io::field("position", &point_view::position),
                io::field("confidence", &point_view::confidence), io::field("has_moved", &point_view::has_moved),
                io::field("seen_ago_ms", &point_view::seen_ago_ms),
                io::field("decide_within_ms", &point_view::decide_within_ms), io::field("by", &point_view::by));
};

struct points {
  std::string mission_id; // of all of them; empty: there was none yet
  std::vector<point_view> shown;
  std::vector<point_view> confirmed; // of this mission, as far as they are remembered
  std::uint32_t waiting = 0;
  point_counts counts;
  static constexpr auto fields =
      io::table("scan_controller.points", io::field("mission_id", &points::mission_id),
                io::field("shown", &points::shown), io::field("confirmed", &points::confirmed),
                io::field("waiting", &points::waiting), io::field("counts", &points::counts));
};

} // namespace godwit::scan_controller
