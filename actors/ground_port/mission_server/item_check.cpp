#include "actors/ground_port/mission_server/item_check.hpp"

#include <cstdlib>

namespace godwit::ground_port::mission_server {

namespace {

using mavlink::mav_cmd;
using mavlink::mav_frame;
using mavlink::mav_mission_result;
using mavlink::mav_mission_type;
using mavlink::number;

constexpr std::int32_t max_latitude = 900'000'000; // 1e-7 degrees
constexpr std::int32_t max_longitude = 1'800'000'000;

bool is_known_command(std::uint16_t command, std::uint8_t mission_type) {
  if (io::name_of(static_cast<mav_cmd>(command)).empty())
    return false;
  const bool is_fence =
      command >= number(mav_cmd::nav_fence_return_point) && command <= number(mav_cmd::nav_fence_circle_exclusion);
  const bool is_rally = command == number(mav_cmd::nav_rally_point);
  switch (static_cast<mav_mission_type>(mission_type)) {
  case mav_mission_type::fence:
    return is_fence;
  case mav_mission_type::rally:
    return is_rally;
  default:
    return !is_fence && !is_rally;
  }
}

bool has_position(const mavlink::mission_item_int& item) {
  return item.frame != number(mav_frame::mission) && (item.x != 0 || item.y != 0);
}

} // namespace

mav_mission_result check_item(const mavlink::mission_item_int& item, const habits& vehicle) {
  if (!is_known_command(item.command, item.mission_type))
    return mav_mission_result::unsupported;
  if (io::name_of(static_cast<mav_frame>(item.frame)).empty())
    return mav_mission_result::unsupported_frame;
  if (vehicle.checks_latitude && has_position(item)) {
    if (std::abs(std::int64_t{item.x}) > max_latitude)
      return mav_mission_result::invalid_param5_x;
    if (std::abs(std::int64_t{item.y}) > max_longitude)
      return mav_mission_result::invalid_param6_y;
  }
  return mav_mission_result::accepted;
}

} // namespace godwit::ground_port::mission_server
