#include "programs/godwit-sim/vehicle/flight/item_place.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame_meaning.hpp"

namespace godwit::sim {

namespace mavlink = io::mavlink;
using mavlink::mission_item_int;

namespace {

constexpr double units_in_a_degree = mavlink::units_of(mavlink::coordinate_kind::global);
constexpr std::int32_t unset = std::numeric_limits<std::int32_t>::max();

bool has_no_position(std::uint8_t frame) { return frame == mavlink::number(mavlink::mav_frame::mission); }

// What altitudes in FRAME are counted from; nothing: the frame is not known. The ground is as high as home everywhere.
std::optional<double> origin_of(std::uint8_t frame, double home_m) {
  if (has_no_position(frame))
    return home_m;
  const auto kind = mavlink::altitude_in(frame);
  if (!kind)
    return std::nullopt;
  return kind == mavlink::altitude_kind::above_sea ? 0 : home_m;
}

bool may_leave_its_place_out(std::uint16_t command) {
  return command == nav_takeoff || command == nav_land || command == nav_vtol_takeoff || command == nav_vtol_land ||
         command == nav_loiter_to_alt || command == nav_loiter_unlim || command == nav_loiter_turns ||
         command == nav_loiter_time;
}

} // namespace

tl::expected<item_place, std::string> place_of(const mission_item_int& item, const position& home,
                                               const position& here) {
  const auto origin_m = origin_of(item.frame, home.altitude_m);
  if (!origin_m)
    return tl::unexpected("frame " + std::to_string(item.frame) + " is not known");
  item_place place{here};
  const bool is_left_out = item.x == 0 && item.y == 0 && may_leave_its_place_out(item.command);
  place.is_here = is_left_out || has_no_position(item.frame) || item.x == unset || item.y == unset;
  if (!place.is_here) {
    place.at.latitude_deg = item.x / units_in_a_degree;
    place.at.longitude_deg = item.y / units_in_a_degree;
    if (std::abs(place.at.latitude_deg) > 90 || std::abs(place.at.longitude_deg) > 180)
      return tl::unexpected(std::string("its position is not on Earth"));
  }
  place.has_own_altitude = std::isfinite(item.z) && !(place.is_here && item.z == 0);
  if (place.has_own_altitude)
    place.at.altitude_m = *origin_m + static_cast<double>(item.z);
  return place;
}

} // namespace godwit::sim
