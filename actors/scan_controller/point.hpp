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
  static constexpr auto fields =
      io::table("scan_controller.point", io::field("number", &point::number), io::field("id", &point::id),
                io::field("object_id", &point::object_id), io::field("class_group", &point::class_group),
                io::field("position", &point::position), io::field("confidence", &point::confidence),
                io::field("has_moved", &point::has_moved), io::field("seen_ns", &point::seen_ns));
};

struct open_point {
  point what;
  std::int64_t until_ns = 0; // a decision counts before it
  static constexpr auto fields = io::table("scan_controller.open_point", io::field("what", &open_point::what),
                                           io::field("until_ns", &open_point::until_ns));
};

struct closed_point {
  point what;
  point_outcome outcome = point_outcome::passed_over;
  std::string by;
  std::int64_t closed_ns = 0;
  static constexpr auto fields =
      io::table("scan_controller.closed_point", io::field("what", &closed_point::what),
                io::field("outcome", &closed_point::outcome), io::field("by", &closed_point::by),
                io::field("closed_ns", &closed_point::closed_ns));
};

enum class drop_reason { too_faint, too_old, no_room };

constexpr auto enum_names(drop_reason) {
  return io::names<drop_reason>(
      {{drop_reason::too_faint, "too_faint"}, {drop_reason::too_old, "too_old"}, {drop_reason::no_room, "no_room"}});
}

} // namespace godwit::scan_controller
