// What of the points of interest must survive a crash: all of it but where the vehicle is.
//
// Times are of the monotonic clock, which all processes of a boot share, so that nobody who sets the wall clock makes
// more points come or a window end. After a start of the computer they are moved back so that no time has passed since
// the last fact: windows last longer then, and no point is shown too soon. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "actors/scan_controller/facts.hpp"
#include "actors/scan_controller/point.hpp"
#include "io/fields/field_table.hpp"
#include "messages/mapobjects_store/operator_verdict.hpp"

namespace godwit::scan_controller {

inline constexpr std::size_t max_waiting = 64;     // the one that is worth least is dropped
inline constexpr std::size_t max_closed = 128;     // the oldest is forgotten, those that are confirmed last
inline constexpr std::size_t max_owed = 64;        // decisions for the map; at it no decision is taken
inline constexpr std::size_t max_owed_passes = 16; // at it a pass is lost
inline constexpr std::size_t max_shown_times = 32; // more than may be shown in a minute

struct state {
  std::string mission_id; // of all points
  std::uint64_t last_number = 0;
  std::int64_t newest_ns = 0;         // of all facts
  std::vector<point> waiting;         // in the order of their numbers
  std::vector<open_point> shown;      // in the order in which they were shown
  std::vector<closed_point> closed;   // oldest first
  std::vector<std::int64_t> shown_ns; // when points were shown, oldest first, as many as the rate needs
  std::vector<mapobjects_store::operator_verdict> owed; // to the map, oldest first
  point_counts counts;
  std::optional<open_pass> pass;
  std::vector<owed_pass> owed_passes; // oldest first

  static constexpr int version = 1;
  GODWIT_FIELDS(state, "scan_controller.state", mission_id, last_number, newest_ns, waiting, shown, closed, shown_ns,
                owed, counts, pass, owed_passes);
};

// The durable core: puts facts into the state. What follows for subscribers comes back.
struct durable_core {
  using state = scan_controller::state;
  using event = fact;
  using effect = std::variant<point_shown, point_closed>;

  [[nodiscard]] static std::vector<effect> apply(state& s, const event& happened, std::int64_t wall_ns);
  [[nodiscard]] static std::vector<effect> resume(const state&, std::int64_t) { return {}; }
};

} // namespace godwit::scan_controller
