#include "actors/domain/mission/convert/item_export.hpp"

#include <map>
#include <string_view>

namespace godwit::mission {

namespace {

using item_list = std::vector<vehicle_item>;

constexpr double ground_speed = 1;
constexpr double keep_throttle = -1;

vehicle_item speed_item(double mps) {
  return {0, command::change_speed, frame::mission, {ground_speed, mps, keep_throttle, 0, 0, 0, 0}};
}

item_list made_of(const takeoff& each) {
  return {{0, command::takeoff, frame::global_relative, {0, 0, 0, not_given, not_given, not_given, each.altitude_m}}};
}

item_list made_of(const waypoint& each) {
  item_list items;
  if (each.speed_mps)
    items.push_back(speed_item(*each.speed_mps));
  items.push_back(
      {0,
       command::waypoint,
       frame::global_relative,
       {each.hold_s, each.accept_radius_m, 0, not_given, each.at.latitude, each.at.longitude, each.at.altitude_m}});
  return items;
}

item_list made_of(const loiter& each) {
  return {{0,
           command::loiter_time,
           frame::global_relative,
           {each.duration_s, 0, each.radius_m, 0, each.at.latitude, each.at.longitude, each.at.altitude_m}}};
}

item_list made_of(const change_speed& each) { return {speed_item(each.mps)}; }

item_list made_of(const survey&) { return {}; }

item_list made_of(const land& each) {
  return {{0,
           command::land,
           frame::global_relative,
           {0, 0, 0, not_given, each.at.latitude, each.at.longitude, each.at.altitude_m}}};
}

item_list made_of(const return_home&) {
  return {{0, command::return_to_launch, frame::mission, {0, 0, 0, 0, 0, 0, 0}}};
}

item_list made_of(const command_item& each) {
  vehicle_item result{0, each.command, each.frame, {}, each.autocontinue};
  for (std::size_t i = 0; i < command_params; ++i)
    result.params[i] = each.params[i].value_or(not_given);
  return {result};
}

item_list made_of(const jump& each) {
  return {{0, command::jump, frame::mission, {0, static_cast<double>(each.times), 0, 0, 0, 0, 0}}};
}

} // namespace

item_list vehicle_items_of(const item& each) {
  return std::visit([](const auto& value) { return made_of(value); }, each);
}

numbered_items numbered_items_of(const document& mission, std::size_t first, bool counts_surveys) {
  numbered_items result;
  std::map<std::string_view, std::size_t> numbers; // of each item's first
  auto number = first;
  for (const auto& each : mission.items) {
    numbers.emplace(id_of(each), number);
    result.push_back(vehicle_items_of(each));
    for (auto& made : result.back())
      made.number = number++;
    if (counts_surveys && std::holds_alternative<survey>(each))
      ++number;
  }
  for (std::size_t i = 0; i < mission.items.size(); ++i)
    if (const auto* each = std::get_if<jump>(&mission.items[i]))
      if (const auto target = numbers.find(each->to); target != numbers.end())
        result[i].front().params[0] = static_cast<double>(target->second);
  return result;
}

planned_home home_to_write(const document& mission) {
  if (mission.planned_home)
    return *mission.planned_home;
  const auto& back = mission.return_point;
  return back ? planned_home{back->latitude, back->longitude, {}} : planned_home{};
}

void add_place_losses(std::span<const item> items, loss_list& losses) {
  for (std::size_t i = 0; i < items.size(); ++i)
    for (const auto& each : vehicle_items_of(items[i]))
      if (each.latitude() == 0 && each.longitude() == 0 && each.frame != frame::mission &&
          !std::holds_alternative<command_item>(items[i]))
        losses.add(
            {i, command_name(each.command) + ": place 0/0", "vehicles take it for no place", "written all the same"});
}

} // namespace godwit::mission
