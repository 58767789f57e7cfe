// A point of interest in its phases. Times: monotonic nanoseconds (state.hpp). Thread: plain values.
//
//   candidate ──> [waiting] ──its turn──> [shown] ──> closed: confirmed, declined, passed_over
//                     └──> dropped: too_faint, too_old, no_room, mission_over
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "actors/domain/geo/point.hpp"
#include "io/fields/field_table.hpp"
#include "messages/mapobjects_store/object.hpp"
#include "messages/scan_controller/point.hpp"

namespace godwit::scan_controller {

struct point {
  std::uint64_t number = 0;
  std::string id;                       // of its first sighting
  std::optional<std::string> object_id; // on the map
  std::string class_group;
  mapobjects_store::geo_position position; // of the newest sighting
  double confidence = 0;                   // the highest
  bool has_moved = false;
  std::int64_t seen_ns = 0; // the newest sighting
  GODWIT_FIELDS(point, "scan_controller.point", number, id, object_id, class_group, position, confidence, has_moved,
                seen_ns);
};

struct open_point {
  point what;
  std::int64_t until_ns = 0; // a decision counts before it
  GODWIT_FIELDS(open_point, "scan_controller.open_point", what, until_ns);
};

struct closed_point {
  point what;
  point_outcome outcome = point_outcome::passed_over;
  std::string by;
  std::int64_t closed_ns = 0;
  GODWIT_FIELDS(closed_point, "scan_controller.closed_point", what, outcome, by, closed_ns);
};

enum class drop_reason { too_faint, too_old, no_room };

GODWIT_ENUM_NAMES(drop_reason, too_faint, too_old, no_room);

// Which point of interest a candidate is about: of the same class group, and the same object of the map or near enough.
// Pure. Thread: any.

[[nodiscard]] bool is_about(const candidate& seen, const point& known, double within_m);

[[nodiscard]] inline const point& point_of(const point& each) { return each; }
template <class Phase>
[[nodiscard]] const point& point_of(const Phase& each) {
  return each.what;
}

// Null: none in the list.
template <class Listed>
[[nodiscard]] const Listed* find_match(const std::vector<Listed>& list, const candidate& seen, double within_m) {
  const auto found =
      std::ranges::find_if(list, [&](const Listed& each) { return is_about(seen, point_of(each), within_m); });
  return found == list.end() ? nullptr : &*found;
}

// How much a point of interest is worth a look now: confidence x nearness x freshness x movement, each 0..1. Pure.
// Thread: any.

// Where each of them has come down to a half.
inline constexpr double half_nearness_m = 500;
inline constexpr double half_freshness_ns = 60e9;
inline constexpr double standing_worth = 0.7; // of what moves

// VEHICLE: where it is; nothing: not known, and all are equally near.
[[nodiscard]] double priority_of(const point& what, const std::optional<geo::point>& vehicle, std::int64_t now_ns);

// A goes before B. What is not above the threshold comes last; among equals the older number comes first.
struct ranked {
  bool is_above = false; // the threshold
  double priority = 0;
  std::uint64_t number = 0;
};
[[nodiscard]] bool goes_before(const ranked& a, const ranked& b);

} // namespace godwit::scan_controller
