#include "actors/executor/plan/mission_look.hpp"

#include <type_traits>

namespace godwit::executor::plan {

namespace {

std::optional<mission::vertex> place_of(const mission::item& each) {
  return std::visit(
      []<class T>(const T& value) -> std::optional<mission::vertex> {
        if constexpr (requires { value.at; })
          return mission::vertex{value.at.latitude, value.at.longitude};
        else if constexpr (std::is_same_v<T, mission::survey>)
          return value.polygon.front();
        else
          return std::nullopt;
      },
      each);
}

template <class Place>
std::optional<mission::vertex> vertex_of(const std::optional<Place>& at) {
  return at ? std::optional(mission::vertex{at->latitude, at->longitude}) : std::nullopt;
}

} // namespace

std::optional<mission::vertex> place_after(const mission::document& mission, std::size_t index) {
  for (std::size_t i = index + 1; i < mission.items.size(); ++i) {
    if (std::holds_alternative<mission::takeoff>(mission.items[i]))
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
  }
  return speed_mps;
}

std::optional<double> take_off_before(const mission::document& mission, std::size_t index) {
  for (std::size_t i = index; i < mission.items.size(); ++i) {
    if (std::holds_alternative<mission::takeoff>(mission.items[i]))
      return std::nullopt;
    if (!std::holds_alternative<mission::change_speed>(mission.items[i]))
      break;
  }
  for (std::size_t i = index; i > 0; --i)
    if (const auto* begin = std::get_if<mission::takeoff>(&mission.items[i - 1]))
      return begin->altitude_m;
  return std::nullopt;
}

bool leads_to_landing(const mission::document& mission, std::size_t index) {
  for (std::size_t i = index + 1; i < mission.items.size(); ++i)
    if (!std::holds_alternative<mission::change_speed>(mission.items[i]))
      return std::holds_alternative<mission::land>(mission.items[i]);
  return false;
}

} // namespace godwit::executor::plan
