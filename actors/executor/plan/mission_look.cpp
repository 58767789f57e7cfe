#include "actors/executor/plan/mission_look.hpp"

#include <algorithm>
#include <map>
#include <type_traits>

#include "actors/domain/mission/commands/item_class.hpp"
#include "actors/executor/plan/change_ids.hpp"
#include "actors/executor/plan/vehicle_items.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame_meaning.hpp"

namespace godwit::executor::plan {

namespace {

using io::mavlink::mav_cmd;
using io::mavlink::number;

std::optional<mission::vertex> place_of(const mission::item& each) {
  return std::visit(
      []<class T>(const T& value) -> std::optional<mission::vertex> {
        if constexpr (requires { value.at; })
          return mission::vertex{value.at.latitude, value.at.longitude};
        else if constexpr (std::is_same_v<T, mission::survey>)
          return value.polygon.front();
        else if constexpr (std::is_same_v<T, mission::command_item>)
          return mission::moves_vehicle(value) ? mission::place_of(value) : std::nullopt;
        else
          return std::nullopt;
      },
      each);
}

template <class Place>
std::optional<mission::vertex> vertex_of(const std::optional<Place>& at) {
  return at ? std::optional(mission::vertex{at->latitude, at->longitude}) : std::nullopt;
}

bool is_command(const mission::item& each) { return std::holds_alternative<mission::command_item>(each); }

// IMAGE_START_CAPTURE of one picture sets nothing for later.
bool is_single_picture(const mission::item& each) {
  const auto* const command = std::get_if<mission::command_item>(&each);
  return command != nullptr && command->command == number(mav_cmd::image_start_capture) && command->params[2] == 1;
}

bool switches_off(const mission::command_item& each) {
  const auto change = trigger_change_of(each.command, each.params[0].value_or(0), each.params[2].value_or(0));
  return each.command == number(mav_cmd::do_set_roi_none) || (change && change->value == 0);
}

} // namespace

std::optional<mission::vertex> place_after(const mission::document& mission, std::size_t index) {
  for (std::size_t i = index + 1; i < mission.items.size(); ++i) {
    if (mission::is_take_off(mission.items[i]))
      return std::nullopt;
    if (const auto place = place_of(mission.items[i]))
      return place;
    if (const auto* back = std::get_if<mission::return_home>(&mission.items[i]))
      return back->to ? std::nullopt : vertex_of(mission.return_point);
  }
  return std::nullopt;
}

mission::vertex place_before(const mission::document& mission, std::size_t index) {
  for (std::size_t i = index; i > 0; --i)
    if (const auto place = place_of(mission.items[i - 1]))
      return *place;
  if (const auto back = vertex_of(mission.return_point))
    return *back;
  if (const auto home = vertex_of(mission.planned_home))
    return *home;
  return place_of(mission.items.at(index)).value_or(mission::vertex{});
}

std::optional<double> speed_before(const mission::document& mission, std::size_t index) {
  std::optional<double> speed_mps;
  for (std::size_t i = 0; i < index; ++i) {
    if (const auto* change = std::get_if<mission::change_speed>(&mission.items[i]))
      speed_mps = change->mps;
    if (const auto* waypoint = std::get_if<mission::waypoint>(&mission.items[i]); waypoint && waypoint->speed_mps)
      speed_mps = waypoint->speed_mps;
    if (is_command(mission.items[i]) && mission::state_of(mission.items[i]) == mission::command_state::speed)
      speed_mps.reset(); // repeated as it was
  }
  return speed_mps;
}

std::optional<double> take_off_before(const mission::document& mission, std::size_t index) {
  for (std::size_t i = index; i < mission.items.size(); ++i) {
    if (mission::is_take_off(mission.items[i]))
      return std::nullopt;
    if (mission::class_of(mission.items[i]) != mission::command_class::acts)
      break;
  }
  for (std::size_t i = index; i > 0; --i) {
    if (const auto* begin = std::get_if<mission::takeoff>(&mission.items[i - 1]))
      return begin->altitude_m;
    if (const auto* command = std::get_if<mission::command_item>(&mission.items[i - 1]);
        command != nullptr && mission::is_take_off(mission.items[i - 1]))
      return io::mavlink::altitude_in(command->frame) == io::mavlink::altitude_kind::above_home ? command->params.back()
                                                                                                : std::nullopt;
  }
  return std::nullopt;
}

std::vector<std::size_t> state_before(const mission::document& mission, std::size_t index) {
  using mission::command_state;
  std::map<command_state, std::size_t> last;
  for (std::size_t i = 0; i < index; ++i) {
    const auto state = mission::state_of(mission.items[i]);
    if (state != command_state::none && !is_single_picture(mission.items[i]))
      last[state] = i;
  }
  std::vector<std::size_t> found;
  for (const auto& [state, at] : last)
    if (is_command(mission.items[at]) && !switches_off(std::get<mission::command_item>(mission.items[at])))
      found.push_back(at);
  std::ranges::sort(found);
  return found;
}

std::optional<std::size_t> waypoint_before(const mission::document& mission, std::size_t index) {
  for (std::size_t i = index; i > 0; --i) {
    const auto& each = mission.items[i - 1];
    if (is_of_change(mission::id_of(each)))
      continue; // an operator has sent it there from the line
    const auto* const command = std::get_if<mission::command_item>(&each);
    if (std::holds_alternative<mission::waypoint>(each) ||
        (command != nullptr && command->command == number(mav_cmd::nav_waypoint)))
      return i - 1;
    if (mission::moves_vehicle(each))
      break;
  }
  return std::nullopt;
}

bool leads_to_landing(const mission::document& mission, std::size_t index) {
  for (std::size_t i = index + 1; i < mission.items.size(); ++i)
    if (mission::class_of(mission.items[i]) != mission::command_class::acts)
      return std::holds_alternative<mission::land>(mission.items[i]);
  return false;
}

} // namespace godwit::executor::plan
