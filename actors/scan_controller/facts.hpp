// What has happened to the points of interest and to the passes, as the journal keeps it. A fact is put into the state
// and decides nothing. `at_ns` is monotonic. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "actors/scan_controller/pass.hpp"
#include "actors/scan_controller/point.hpp"
#include "io/fields/field_table.hpp"

namespace godwit::scan_controller {

// The computer was started anew: its monotonic clock is behind by so much.
struct clock_restarted {
  std::int64_t behind_ns = 0;
  static constexpr auto fields =
      io::table("scan_controller.clock_restarted", io::field("behind_ns", &clock_restarted::behind_ns));
};

// All points are of this one from now on; the others are dropped, or passed over where they were shown.
struct mission_begun {
  std::string mission_id;
  std::int64_t at_ns = 0;
  static constexpr auto fields =
      io::table("scan_controller.mission_begun", io::field("mission_id", &mission_begun::mission_id),
                io::field("at_ns", &mission_begun::at_ns));
};

struct point_opened {
  point what;
  std::uint64_t again = 0; // number of the one that was passed over and is forgotten for it; 0: none
  std::int64_t at_ns = 0;
  static constexpr auto fields =
      io::table("scan_controller.point_opened", io::field("what", &point_opened::what),
                io::field("again", &point_opened::again), io::field("at_ns", &point_opened::at_ns));
};

// Seen again.
struct point_seen {
  point now; // as it is with the new sighting; its number says which
  std::int64_t at_ns = 0;
  static constexpr auto fields = io::table("scan_controller.point_seen", io::field("now", &point_seen::now),
                                           io::field("at_ns", &point_seen::at_ns));
};

struct point_dropped {
  std::uint64_t number = 0; // 0: it was dropped as it came
  drop_reason why = drop_reason::too_old;
  std::int64_t at_ns = 0;
  static constexpr auto fields =
      io::table("scan_controller.point_dropped", io::field("number", &point_dropped::number),
                io::field("why", &point_dropped::why), io::field("at_ns", &point_dropped::at_ns));
};

struct showing_begun {
  std::uint64_t number = 0;
  std::int64_t window_ms = 0;
  std::uint32_t most_a_minute = 0;
  std::int64_t at_ns = 0;
  static constexpr auto fields =
      io::table("scan_controller.showing_begun", io::field("number", &showing_begun::number),
                io::field("window_ms", &showing_begun::window_ms),
                io::field("most_a_minute", &showing_begun::most_a_minute), io::field("at_ns", &showing_begun::at_ns));
};

// A person has decided, or the window is over.
struct showing_ended {
  std::uint64_t number = 0;
  point_outcome outcome = point_outcome::passed_over;
  std::string by;
  std::int64_t at_ns = 0;
  std::int64_t wall_ns = 0; // for the map
  static constexpr auto fields =
      io::table("scan_controller.showing_ended", io::field("number", &showing_ended::number),
                io::field("outcome", &showing_ended::outcome), io::field("by", &showing_ended::by),
                io::field("at_ns", &showing_ended::at_ns), io::field("wall_ns", &showing_ended::wall_ns));
};

// The map has taken the oldest decision that was owed to it, or will never take it.
struct verdict_delivered {
  std::string id;
  static constexpr auto fields =
      io::table("scan_controller.verdict_delivered", io::field("id", &verdict_delivered::id));
};

using fact =
    std::variant<clock_restarted, mission_begun, point_opened, point_seen, point_dropped, showing_begun, showing_ended,
                 verdict_delivered, pass_begun, pass_advanced, pass_lost, pass_completed, pass_delivered>;

} // namespace godwit::scan_controller
