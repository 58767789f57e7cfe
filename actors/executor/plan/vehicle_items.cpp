#include "actors/executor/plan/vehicle_items.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "actors/domain/mission/commands/item_class.hpp"
#include "io/mavlink/frame_meaning.hpp"

namespace godwit::executor::plan {

namespace {

using io::mavlink::mav_cmd;
using io::mavlink::mav_frame;
using io::mavlink::number;

using four_params = std::array<double, 4>;

constexpr double keep_throttle = -1;
constexpr double air_speed = 0;
constexpr double ground_speed = 1;

std::int32_t scaled(double degrees) {
  return static_cast<std::int32_t>(std::lround(degrees * io::mavlink::units_of(io::mavlink::coordinate_kind::global)));
}

mission_item_int item_of(mav_cmd command, mav_frame frame, const four_params& params) {
  mission_item_int item;
  item.command = number(command);
  item.frame = number(frame);
  item.autocontinue = 1;
  item.param1 = static_cast<float>(params[0]);
  item.param2 = static_cast<float>(params[1]);
  item.param3 = static_cast<float>(params[2]);
  item.param4 = static_cast<float>(params[3]);
  return item;
}

mission_item_int placed_item(mav_cmd command, const four_params& params, const mission::position& at,
                             const plan_setting& setting) {
  auto item = item_of(command, mav_frame::global_relative_alt, params);
  item.x = scaled(at.latitude);
  item.y = scaled(at.longitude);
  item.z = static_cast<float>(at.altitude_m - setting.home.above_mission_zero_m);
  return item;
}

mission_item_int item_at_home(mav_cmd command, const plan_setting& setting) {
  auto item = item_of(command, mav_frame::global, {});
  item.x = scaled(setting.home.latitude);
  item.y = scaled(setting.home.longitude);
  item.z = static_cast<float>(setting.home.above_sea_m);
  return item;
}

mission_item_int bare_item(mav_cmd command, const four_params& params) {
  return item_of(command, mav_frame::mission, params);
}

double any_yaw(const plan_setting& setting) {
  return is_ardupilot(setting) ? 0 : std::numeric_limits<double>::quiet_NaN();
}

double waiting_s(double asked_s, const plan_setting& setting) {
  return is_ardupilot(setting) ? std::ceil(asked_s) : asked_s;
}

} // namespace

bool is_ardupilot(const plan_setting& setting) {
  return setting.autopilot == io::mavlink::mav_autopilot::ardupilotmega;
}

bool keeps_home_as_item(const plan_setting& setting) { return is_ardupilot(setting); }

bool sets_home_in_plan(const plan_setting& setting) { return setting.is_home_set_again && is_ardupilot(setting); }

double longest_wait_s(const plan_setting& setting) {
  return is_ardupilot(setting) ? std::numeric_limits<std::uint16_t>::max() : std::numeric_limits<double>::infinity();
}

mission_item_int home_item(const plan_setting& setting) { return item_at_home(mav_cmd::nav_waypoint, setting); }

mission_item_int set_home_item(const plan_setting& setting) { return item_at_home(mav_cmd::do_set_home, setting); }

mission_item_int takeoff_item(const mission::position& towards, const plan_setting& setting) {
  return placed_item(mav_cmd::nav_takeoff, {0, 0, 0, any_yaw(setting)}, towards, setting);
}

mission_item_int waypoint_item(const mission::position& at, double hold_s, double accept_radius_m,
                               const plan_setting& setting) {
  return placed_item(mav_cmd::nav_waypoint, {waiting_s(hold_s, setting), accept_radius_m, 0, any_yaw(setting)}, at,
                     setting);
}

mission_item_int loiter_item(const mission::position& at, double duration_s, double radius_m,
                             const plan_setting& setting) {
  return placed_item(mav_cmd::nav_loiter_time, {waiting_s(duration_s, setting), 0, radius_m, 0}, at, setting);
}

mission_item_int land_item(const mission::position& at, const plan_setting& setting) {
  return placed_item(mav_cmd::nav_land, {0, 0, 0, any_yaw(setting)}, at, setting);
}

mission_item_int return_item() { return bare_item(mav_cmd::nav_return_to_launch, {}); }

bool is_return_item(const mission_item_int& item) {
  return item.command == io::mavlink::number(mav_cmd::nav_return_to_launch);
}

mission_item_int speed_item(double mps, const plan_setting& setting) {
  const double kind = setting.vehicle == vehicle_class::fixed_wing ? air_speed : ground_speed;
  return bare_item(mav_cmd::do_change_speed, {kind, mps, keep_throttle, 0});
}

mission_item_int landing_start_item() { return bare_item(mav_cmd::do_land_start, {}); }

mission_item_int command_item_of(const mission::command_item& item, const plan_setting& setting) {
  const auto value = [&](std::size_t index) {
    return static_cast<float>(item.params.at(index).value_or(any_yaw(setting)));
  };
  mission_item_int result;
  result.command = item.command;
  result.frame = item.frame;
  result.autocontinue = item.autocontinue ? 1 : 0;
  result.param1 = value(0);
  result.param2 = value(1);
  result.param3 = value(2);
  result.param4 = value(3);
  const auto kind = io::mavlink::coordinates_of(item.frame).value_or(io::mavlink::coordinate_kind::none);
  const bool has_degrees = kind == io::mavlink::coordinate_kind::global;
  const auto coordinate = [&](const std::optional<double>& given) {
    constexpr auto unset = std::numeric_limits<std::int32_t>::max();
    if (!given)
      return has_degrees && !is_ardupilot(setting) ? unset : 0;
    const auto scaled_value =
        std::clamp(*given * (has_degrees ? io::mavlink::units_a_degree : 1), -2147483647.0, static_cast<double>(unset));
    return static_cast<std::int32_t>(std::lround(scaled_value));
  };
  result.x = coordinate(item.params[mission::latitude_param]);
  result.y = coordinate(item.params[mission::longitude_param]);
  const bool is_above_home = io::mavlink::altitude_in(item.frame) == io::mavlink::altitude_kind::above_home;
  result.z = item.params[mission::altitude_param] && is_above_home && mission::moves_vehicle(item)
                 ? static_cast<float>(*item.params[mission::altitude_param] - setting.home.above_mission_zero_m)
                 : value(mission::altitude_param);
  return result;
}

double altitude_of(const mission::command_item& item, const plan_setting& setting) {
  const double given = item.params[mission::altitude_param].value_or(0);
  if (io::mavlink::altitude_in(item.frame) != io::mavlink::altitude_kind::above_sea)
    return given;
  return given - setting.home.above_sea_m + setting.home.above_mission_zero_m;
}

mission_item_int jump_item(std::int32_t times) {
  return bare_item(mav_cmd::do_jump, {0, static_cast<double>(times), 0, 0});
}

std::optional<trigger_change> trigger_change_of(std::uint16_t command, double param1, double param3) {
  using by = trigger_change::by;
  switch (static_cast<mav_cmd>(command)) {
  case mav_cmd::do_set_cam_trigg_dist:
    return trigger_change{by::distance, std::max(0.0, param1)};
  case mav_cmd::do_set_cam_trigg_interval:
  case mav_cmd::do_trigger_control:
    return trigger_change{by::time, param1 > 0 ? 1.0 : 0.0};
  case mav_cmd::image_start_capture:
    return param3 == 1 ? std::nullopt : std::optional(trigger_change{by::time, 1});
  case mav_cmd::image_stop_capture:
    return trigger_change{by::time, 0};
  default:
    return std::nullopt;
  }
}

std::optional<mission_item_int> camera_to_stop(std::span<const mission_item_int> items, std::size_t sequence) {
  std::optional<mission_item_int> found;
  for (const auto& each : items.first(std::min(sequence, items.size()))) {
    const auto change = trigger_change_of(each);
    if (!change)
      continue;
    found.reset();
    if (change->value == 0)
      continue;
    const bool captures = each.command == number(mav_cmd::image_start_capture);
    found = each;
    found->param1 = captures ? each.param1 : 0; // its camera
    found->param2 = found->param3 = 0;
    if (captures)
      found->command = number(mav_cmd::image_stop_capture);
  }
  return found;
}

std::vector<mission_item_int> state_at(std::span<const mission_item_int> items, std::size_t sequence) {
  using mission::command_state;
  std::map<command_state, mission_item_int> last;
  for (const auto& each : items.first(std::min(sequence, items.size())))
    if (const auto* const row = mission::command_of(each.command); row != nullptr)
      last[row->state] = each;
  std::vector<mission_item_int> result;
  for (const auto kind : {command_state::speed, command_state::roi, command_state::gimbal})
    if (const auto found = last.find(kind);
        found != last.end() && found->second.command != number(mav_cmd::do_set_roi_none))
      result.push_back(found->second);
  return result;
}

// A plane flies past a waypoint and does not wait for NAV_DELAY; an ArduPilot flies on while a CONDITION_DELAY runs.
double wait_of(const mission_item_int& item, const plan_setting& setting) {
  const bool is_plane = setting.vehicle == vehicle_class::fixed_wing;
  const double seconds = std::isfinite(item.param1) ? std::max(0.0F, item.param1) : 0;
  switch (static_cast<mav_cmd>(item.command)) {
  case mav_cmd::nav_loiter_time:
    return seconds;
  case mav_cmd::nav_waypoint:
  case mav_cmd::nav_delay:
    return is_plane ? 0 : seconds;
  case mav_cmd::condition_delay:
    return is_ardupilot(setting) ? 0 : seconds;
  default:
    return 0;
  }
}

bool is_nav(const mission_item_int& item) {
  const bool is_beyond = item.command == number(mav_cmd::nav_set_yaw_speed) || item.command == 42'702 ||
                         item.command == 42'703; // NAV_SCRIPT_TIME, NAV_ATTITUDE_TIME
  return (item.command <= number(mav_cmd::nav_last) && item.command != number(mav_cmd::nav_roi)) || is_beyond;
}

bool is_nowhere(const mission::position& at) { return scaled(at.latitude) == 0 && scaled(at.longitude) == 0; }

} // namespace godwit::executor::plan
