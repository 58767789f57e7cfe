#include "actors/domain/mission/convert/item_import.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "actors/domain/mission/commands/item_class.hpp"
#include "io/mavlink/frame_meaning.hpp"

namespace godwit::mission {

namespace {

constexpr const char* left_out = "left out";

bool is_above_home(const vehicle_item& each) {
  return each.frame == frame::global_relative || each.frame == frame::global_relative_int;
}

double given_or_zero(double value) { return std::isfinite(value) ? value : 0; }

bool are_zero(const vehicle_item& each, std::initializer_list<std::size_t> params) {
  return std::ranges::all_of(params, [&](std::size_t n) { return given_or_zero(each.param(n)) == 0; });
}

std::string new_id(std::size_t count) { return "item-" + std::to_string(count + 1); }

command_item command_of_item(const vehicle_item& each) {
  command_item result{{}, each.command, each.frame, {}, each.autocontinue};
  for (std::size_t i = 0; i < command_params; ++i)
    if (std::isfinite(each.params[i]))
      result.params[i] = each.params[i];
  return result;
}

// The times of a DO_JUMP; what is not given is none.
std::int32_t times_of(const vehicle_item& each) {
  constexpr double most = 65'535;
  const auto times = given_or_zero(each.param(2));
  return times < 0 ? -1 : static_cast<std::int32_t>(std::min(times, most));
}

} // namespace

import_context context_of(bool is_for_px4, std::optional<vehicle_profile> vehicle, const allowed_commands& allowed) {
  return {vehicle ? is_px4(*vehicle) : is_for_px4, vehicle, allowed};
}

void item_importer::append(item each, source_place where, std::size_t number) {
  std::visit([&](auto& value) { value.id = new_id(items_.size()); }, each);
  items_.push_back(std::move(each));
  places_.push_back(std::move(where));
  numbers_.push_back(number);
  jump_numbers_.push_back(number + 1); // of a plan, whose home is 0
}

void item_importer::append(const vehicle_item& from, item each) {
  append(std::move(each), {from.place, "item " + std::to_string(from.number) + ", " + command_name(from.command)},
         from.number);
  jump_numbers_.back() = from.jump_number.value_or(from.number);
}

bool item_importer::may_be_carried(const vehicle_item& each) {
  if (auto why = why_not_carried(each.command, context_.allowed); !why.empty()) {
    lose(each, "the item", std::move(why), left_out);
    return false;
  }
  const auto* const row = command_of(each.command);
  if (row == nullptr)
    return true;
  if (context_.vehicle && row->answer_of(*context_.vehicle) == item_answer::refused) {
    lose(each, "the item",
         "a vehicle of the kind " + std::string(io::name_of(*context_.vehicle)) + " refuses a mission with it",
         left_out);
    return false;
  }
  if (row->kind != command_class::moves || !row->has_place)
    return true;
  if (io::mavlink::coordinates_of(each.frame) != io::mavlink::coordinate_kind::global) {
    lose(each, "place in frame " + std::to_string(each.frame), "vehicles do not take it, or take it for another height",
         left_out);
    return false;
  }
  if (!std::isfinite(each.altitude_m())) {
    lose(each, "the item", "it has no altitude", left_out);
    return false;
  }
  return true;
}

// NaN is "as usual" (MAVLink, MISSION_ITEM_INT); infinity is nothing that a vehicle could do.
bool item_importer::is_infinite(const vehicle_item& each) {
  for (std::size_t n = 1; n <= 4; ++n)
    if (std::isinf(each.param(n))) {
      lose(each, "the item", "its parameter " + std::to_string(n) + " is infinite", left_out);
      return true;
    }
  return false;
}

void item_importer::take(const vehicle_item& each) {
  if (!may_be_carried(each) || is_infinite(each))
    return;
  if (each.command == command::jump)
    return take_jump(each);
  auto planned = each.autocontinue ? planned_of(each) : std::nullopt;
  append(each, planned ? *std::move(planned) : item(command_of_item(each)));
  if (each.has_place() && moves_vehicle(items_.back()))
    last_place_ = vertex{each.latitude(), each.longitude()};
}

std::optional<item> item_importer::planned_of(const vehicle_item& each) const {
  switch (each.command) {
  case command::takeoff:
    return takeoff_of(each);
  case command::waypoint:
    return waypoint_of(each);
  case command::loiter_time:
    return loiter_of(each);
  case command::land:
    return land_of(each);
  case command::return_to_launch:
    return return_home{{}, return_goal::home};
  case command::change_speed:
    return speed_of(each);
  default:
    return std::nullopt;
  }
}

std::optional<item> item_importer::takeoff_of(const vehicle_item& each) const {
  const bool is_of_rover = is(vehicle_profile::ardurover) || is(vehicle_profile::px4_rover);
  const bool names_place = std::isfinite(each.latitude()) || std::isfinite(each.longitude());
  if (!is_above_home(each) || !(each.altitude_m() > 0) || !are_zero(each, {1, 2, 3}) || has_yaw(each) || names_place ||
      is_of_rover)
    return std::nullopt;
  return takeoff{{}, each.altitude_m()};
}

std::optional<item> item_importer::waypoint_of(const vehicle_item& each) const {
  if (!is_above_home(each) || !each.has_place() || !are_zero(each, {3}) || has_yaw(each) ||
      !waits_so_long(given_or_zero(each.param(1))))
    return std::nullopt;
  return waypoint{{},
                  {each.latitude(), each.longitude(), each.altitude_m()},
                  given_or_zero(each.param(1)),
                  given_or_zero(each.param(2)),
                  {}};
}

std::optional<item> item_importer::loiter_of(const vehicle_item& each) const {
  if (!is_above_home(each) || !each.has_place() || !are_zero(each, {2, 4}) || !is_for_multirotor() ||
      !std::isfinite(each.param(1)) || !waits_so_long(each.param(1)))
    return std::nullopt;
  return loiter{
      {}, {each.latitude(), each.longitude(), each.altitude_m()}, given_or_zero(each.param(3)), each.param(1)};
}

// A PX4 has no "here".
std::optional<item> item_importer::land_of(const vehicle_item& each) const {
  const bool has_place = each.has_place() || (context_.is_for_px4 && last_place_);
  if (!is_above_home(each) || !has_place || !are_zero(each, {1, 2, 3}) || has_yaw(each) || !is_for_multirotor())
    return std::nullopt;
  const auto place = each.has_place() ? vertex{each.latitude(), each.longitude()} : *last_place_;
  return land{{}, {place.latitude, place.longitude, each.altitude_m()}};
}

std::optional<item> item_importer::speed_of(const vehicle_item& each) const {
  constexpr double over_ground = 1;
  constexpr double no_throttle = -1;
  if (each.param(1) != over_ground || each.param(3) != no_throttle || !are_zero(each, {4}) || !(each.param(2) > 0) ||
      !is_for_multirotor())
    return std::nullopt;
  return change_speed{{}, each.param(2)};
}

void item_importer::take_jump(const vehicle_item& each) {
  append(each, jump{{}, {}, times_of(each)});
  jumps_.push_back({items_.size() - 1, each});
}

void item_importer::resolve_jumps() {
  std::vector<std::size_t> nowhere;
  for (const auto& [index, from] : jumps_) {
    const auto wanted = from.param(1);
    // What was left out has no item: the next one stands for it.
    const auto found =
        std::ranges::find_if(jump_numbers_, [&](std::size_t each) { return static_cast<double>(each) >= wanted; });
    if (wanted >= static_cast<double>(jump_numbers_.front()) && found != jump_numbers_.end())
      std::get<jump>(items_[index]).to = id_of(items_[static_cast<std::size_t>(found - jump_numbers_.begin())]);
    else
      nowhere.push_back(index);
  }
  for (const auto& [index, from] : jumps_)
    if (std::ranges::find(nowhere, index) != nowhere.end())
      lose(from, "jump to item " + number_text(from.param(1)), "the mission has no such item", left_out);
  std::for_each(nowhere.rbegin(), nowhere.rend(), [this](std::size_t index) { erase(index); });
  jumps_.clear();
}

void item_importer::erase(std::size_t index) {
  const auto at = static_cast<std::ptrdiff_t>(index);
  items_.erase(items_.begin() + at);
  places_.erase(places_.begin() + at);
  numbers_.erase(numbers_.begin() + at);
  jump_numbers_.erase(jump_numbers_.begin() + at);
}

void item_importer::lose(const vehicle_item& each, const std::string& what, std::string why, std::string instead) {
  losses_.add({each.number, command_name(each.command) + ": " + what, std::move(why), std::move(instead),
               each.place.starts_with("line") ? each.place : std::string()});
}

bool item_importer::has_yaw(const vehicle_item& each) const {
  return std::isfinite(each.param(4)) && (each.param(4) != 0 || !is_for_ardupilot());
}

} // namespace godwit::mission
