// A point of interest in its phases. Times: monotonic nanoseconds (state.hpp). Thread: plain values.
//
//   candidate ──> [waiting] ──its turn──> [shown] ──> closed: confirmed, declined, passed_over
//                     └──> dropped: too_faint, too_old, no_room, mission_over
#pragma once

#include <cstdint>
#include <optional>
#include <string>

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

} // namespace godwit::scan_controller
