#include "actors/ground_port/mission_server/item_forms.hpp"

#include <cmath>
#include <limits>

#include "actors/domain/mission/commands/command_table.hpp"
#include "io/mavlink/frame_meaning.hpp"

namespace godwit::ground_port::mission_server {

namespace {

using mavlink::mav_cmd;
using mavlink::mav_frame;
using mavlink::number;

double units(std::uint8_t frame) {
  return mavlink::units_of(mavlink::coordinates_of(frame).value_or(mavlink::coordinate_kind::local));
}

// The fields that both messages have.
template <class To, class From>
To with_common_fields(const From& from) {
  To to;
  to.target_system = from.target_system;
  to.target_component = from.target_component;
  to.seq = from.seq;
  to.frame = from.frame;
  to.command = from.command;
  to.current = from.current;
  to.autocontinue = from.autocontinue;
  to.param1 = from.param1;
  to.param2 = from.param2;
  to.param3 = from.param3;
  to.param4 = from.param4;
  to.z = from.z;
  to.mission_type = from.mission_type;
  return to;
}

// A value that does not fit is as far away as can be said, and no position. So is one that is no number: MAVLink says
// so with the greatest integer.
std::int32_t rounded(double value) {
  constexpr double limit = 2'147'483'647.0;
  if (std::isnan(value))
    return std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::lround(std::fmax(-limit, std::fmin(value, limit))));
}

} // namespace

mavlink::mission_item_int in_integers(const mavlink::mission_item& item) {
  auto result = with_common_fields<mavlink::mission_item_int>(item);
  result.x = rounded(double{item.x} * units(item.frame));
  result.y = rounded(double{item.y} * units(item.frame));
  return result;
}

mavlink::mission_item in_floats(const mavlink::mission_item_int& item) {
  auto result = with_common_fields<mavlink::mission_item>(item);
  if (item.frame == number(mav_frame::global_relative_alt_int))
    result.frame = number(mav_frame::global_relative_alt);
  if (item.frame == number(mav_frame::global_int))
    result.frame = number(mav_frame::global);
  result.x = static_cast<float>(item.x / units(item.frame));
  result.y = static_cast<float>(item.y / units(item.frame));
  return result;
}

mavlink::mission_item_int as_kept(mavlink::mission_item_int item, const server_profile& vehicle) {
  item.target_system = 0;
  item.target_component = 0;
  if (!vehicle.rewrites_items)
    return item;
  if (item.frame == number(mav_frame::global_relative_alt_int))
    item.frame = number(mav_frame::global_relative_alt);
  const auto* const row = mission::command_of(item.command);
  const bool keeps_altitude = item.command == number(mav_cmd::nav_continue_and_change_alt);
  if (row != nullptr && !row->has_place && !keeps_altitude) {
    item.x = 0;
    item.y = 0;
    item.z = 0;
    item.frame = number(mav_frame::global);
  }
  if (item.frame == number(mav_frame::global_int))
    item.frame = number(mav_frame::global);
  if (item.frame == number(mav_frame::global_terrain_alt_int))
    item.frame = number(mav_frame::global_terrain_alt);
  if (item.command == number(mav_cmd::nav_waypoint))
    item.param2 = 0;
  item.autocontinue = 1;
  item.current = 0;
  item.z = std::isnan(item.z) ? 0.0F : std::round(item.z * 100.0F) / 100.0F;
  return item;
}

} // namespace godwit::ground_port::mission_server
