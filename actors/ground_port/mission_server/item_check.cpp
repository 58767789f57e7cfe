#include "actors/ground_port/mission_server/item_check.hpp"

#include <cstdlib>

#include "actors/ground_port/mission_server/item_commands.hpp"

namespace godwit::ground_port::mission_server {

namespace {

using mavlink::mav_frame;
using mavlink::mav_mission_result;
using mavlink::mav_mission_type;
using mavlink::number;

constexpr std::int32_t max_latitude = 900'000'000; // 1e-7 degrees
constexpr std::int32_t max_longitude = 1'800'000'000;

} // namespace

mav_mission_result check_item(const mavlink::mission_item_int& item, const autopilot_quirks& vehicle) {
  const auto place = place_of(item.command, static_cast<mav_mission_type>(item.mission_type));
  const auto* const row = mission::command_of(item.command);
  const bool is_refused =
      vehicle.profile && row != nullptr && row->answer_of(*vehicle.profile) == mission::item_answer::refused;
  if (!place || is_refused)
    return mav_mission_result::unsupported;
  if (io::name_of(static_cast<mav_frame>(item.frame)).empty())
    return mav_mission_result::unsupported_frame;
  const bool is_somewhere = *place == item_place::at_a_position && item.frame != number(mav_frame::mission);
  if (!vehicle.checks_latitude || !is_somewhere)
    return mav_mission_result::accepted;
  if (std::abs(std::int64_t{item.x}) > max_latitude)
    return mav_mission_result::invalid_param5_x;
  if (std::abs(std::int64_t{item.y}) > max_longitude)
    return mav_mission_result::invalid_param6_y;
  return mav_mission_result::accepted;
}

} // namespace godwit::ground_port::mission_server
