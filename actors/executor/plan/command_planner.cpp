// Items of a mission that go to the vehicle as they came; see item_planner.hpp.
#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "actors/domain/mission/commands/item_class.hpp"
#include "actors/executor/plan/item_planner.hpp"
#include "actors/executor/plan/line_rest.hpp"
#include "actors/executor/plan/mission_look.hpp"
#include "actors/executor/plan/places.hpp"
#include "actors/executor/plan/vehicle_items.hpp"

namespace godwit::executor::plan {

namespace {

using io::mavlink::mav_cmd;
using io::mavlink::number;
using mission::command_class;
using mission::item_answer;
using progress::item_role;

std::string name_of(const mission::command_item& item) {
  const auto* const row = mission::command_of(item.command);
  return row == nullptr ? "Command " + std::to_string(item.command) : std::string(row->name);
}

// Of the circles that it flies; 0: the vehicle's own.
double circle_of(const mission::command_item& item) {
  switch (static_cast<mav_cmd>(item.command)) {
  case mav_cmd::nav_loiter_unlim:
  case mav_cmd::nav_loiter_turns:
  case mav_cmd::nav_loiter_time:
    return item.params[2].value_or(0);
  case mav_cmd::nav_loiter_to_alt:
    return item.params[1].value_or(0);
  default:
    return 0;
  }
}

bool is_loiter(const mission::command_item& item) {
  return item.command == number(mav_cmd::nav_loiter_unlim) || item.command == number(mav_cmd::nav_loiter_turns) ||
         item.command == number(mav_cmd::nav_loiter_time) || item.command == number(mav_cmd::nav_loiter_to_alt);
}

} // namespace

item_answer item_planner::answer_to(const mission::command_item& item) const {
  const auto* const row = mission::command_of(item.command);
  return row == nullptr || !setting_.profile ? item_answer::taken : row->answer_of(*setting_.profile);
}

item_planner::outcome item_planner::why_not_command(const mission::command_item& item) const {
  if (auto why = mission::why_not_carried(item.command, setting_.allowed_commands); !why.empty())
    return error(plan_errc::command_not_allowed, name_of(item) + " is not flown: " + why, "leave it out");
  if (answer_to(item) == item_answer::refused)
    return error(plan_errc::command_refused,
                 "A vehicle of the kind " + std::string(io::name_of(*setting_.profile)) + " refuses a mission with " +
                     name_of(item),
                 "leave it out");
  return std::nullopt;
}

item_planner::outcome item_planner::plan(const mission::command_item& item) {
  if (auto problem = why_not_command(item))
    return problem;
  if (answer_to(item) == item_answer::skipped) {
    if (mission::moves_vehicle(item) && mission::has_place(item))
      writer_.note("Item '" + item.id + "' (" + name_of(item) +
                   ") is passed over by this kind of vehicle: its place is not visited.");
    writer_.add_verbatim(command_item_of(item, setting_), item_role::unflown);
    return std::nullopt;
  }
  if (mission::moves_vehicle(item))
    return move(item);
  writer_.add_verbatim(command_item_of(item, setting_), item_role::acts);
  return std::nullopt;
}

item_planner::outcome item_planner::move(const mission::command_item& item) {
  switch (static_cast<mav_cmd>(item.command)) {
  case mav_cmd::nav_takeoff:
  case mav_cmd::nav_vtol_takeoff:
    return take_off(item);
  case mav_cmd::do_vtol_transition:
    writer_.add_verbatim(command_item_of(item, setting_), item_role::acts);
    return std::nullopt;
  default:
    break;
  }
  if (auto problem = why_not_flown())
    return problem;
  if (mission::has_place(item))
    return go_to(item);
  if (item.params[mission::altitude_param])
    writer_.climb_to(altitude_of(item, setting_)); // NAV_CONTINUE_AND_CHANGE_ALT
  writer_.add_verbatim(command_item_of(item, setting_), item_role::flown);
  return std::nullopt;
}

// With wings the place gives the direction; a PX4 flies there once it is up. Without a place it climbs where it stands,
// or towards the next place; an ArduPilot reads that out of 0/0, and a PX4 would fly there.
item_planner::outcome item_planner::take_off(const mission::command_item& item) {
  if (writer_.has_moved() && !writer_.is_branch())
    return error(plan_errc::late_take_off, "A take-off does not come in the middle of a flight",
                 "put a waypoint there, which climbs as well, or a land in front of it");
  if (is(vehicle_class::fixed_wing) && writer_.is_in_air())
    return std::nullopt;
  const double top_m = altitude_of(item, setting_);
  if (!(top_m > writer_.start().altitude_m) && !is(vehicle_class::rover))
    return error(plan_errc::no_take_off, "It takes off to a height that is not above the ground it stands on",
                 "give it a height above the ground");
  writer_.climb_to(top_m);
  const auto place = mission::place_of(item);
  auto sent = command_item_of(item, setting_);
  if (!place && !is_ardupilot(setting_)) {
    const auto next = is(vehicle_class::fixed_wing) ? place_after(mission_, index_) : std::nullopt;
    const auto towards =
        takeoff_item(next ? mission::position{next->latitude, next->longitude, 0} : writer_.start(), setting_);
    sent.x = towards.x;
    sent.y = towards.y;
  }
  writer_.add_take_off(sent);
  if (place && !is_ardupilot(setting_) && !is(vehicle_class::fixed_wing))
    writer_.cruise_to({place->latitude, place->longitude, top_m});
  return std::nullopt;
}

item_planner::outcome item_planner::go_to(const mission::command_item& item) {
  const auto place = mission::place_of(item);
  if (!place && !is_ardupilot(setting_))
    return error(plan_errc::no_place, "It has no place, and only ArduPilot takes that for the place where it is",
                 "give it a place");
  auto there = writer_.here();
  if (place)
    there = {place->latitude, place->longitude, altitude_of(item, setting_)};
  if (mission::is_landing(item)) {
    if (stands_at(there))
      return std::nullopt;
    writer_.cruise_to({there.latitude, there.longitude, writer_.here().altitude_m});
    writer_.add_verbatim(command_item_of(item, setting_), item_role::flown);
    writer_.descend_to(place ? there : mission::position{there.latitude, there.longitude, 0});
    return std::nullopt;
  }
  writer_.cruise_to(there);
  writer_.add_verbatim(command_item_of(item, setting_), item_role::flown);
  if (is_loiter(item) && (is(vehicle_class::fixed_wing) || item.command == number(mav_cmd::nav_loiter_turns)))
    writer_.circle(circle_of(item) != 0 ? circle_of(item) : setting_.own_loiter_radius_m);
  return std::nullopt;
}

std::optional<mission::position> item_planner::position_of(const mission::item& item) const {
  return std::visit(
      [&]<class T>(const T& value) -> std::optional<mission::position> {
        if constexpr (requires { value.at; }) {
          return value.at;
        } else if constexpr (std::is_same_v<T, mission::command_item>) {
          const auto place = mission::moves_vehicle(value) ? mission::place_of(value) : std::nullopt;
          return place
                     ? std::optional(mission::position{place->latitude, place->longitude, altitude_of(value, setting_)})
                     : std::nullopt;
        } else {
          return std::nullopt;
        }
      },
      item);
}

// The way that the jump makes is judged as well: from here to the first place after its target.
item_planner::outcome item_planner::plan(const mission::jump& item) {
  const auto& items = mission_.items;
  const auto target = mission::index_of(items, item.to).value_or(items.size());
  for (auto at = target; at < items.size() && item.times != 0; ++at)
    if (const auto place = position_of(items[at])) {
      if (writer_.is_in_air() || is(vehicle_class::rover))
        writer_.jump_to(*place);
      break;
    }
  const auto taken = std::ranges::find(taken_, item.id, &progress::taken_jump::item_id);
  const auto left = taken == taken_.end() || item.times < 0
                        ? item.times
                        : std::max(0, item.times - static_cast<std::int32_t>(taken->taken));
  writer_.add_jump(jump_item(left), item.to);
  return std::nullopt;
}

// An operator has sent the vehicle away from its mission: its speed is kept.
void item_planner::leave_line() {
  if (index_ != *rest_from_)
    return;
  for (const auto index : state_before(mission_, index_)) {
    const auto& command = std::get<mission::command_item>(mission_.items[index]);
    if (mission::state_of(command) == mission::command_state::speed && answer_to(command) == item_answer::taken)
      writer_.repeat(command_item_of(command, setting_));
  }
}

const progress::begun_line* item_planner::line_of_item() const {
  return line_ != nullptr && line_->item_id == mission::id_of(mission_.items[index_]) ? line_ : nullptr;
}

// To where its last picture was taken, or to its beginning at the item BEGIN. A fixed wing comes there straight. True:
// it goes on there.
bool item_planner::lead_in_to_line(std::size_t begin) {
  constexpr double accept_radius_m = 2; // a PX4's own, 10 m, would begin the pictures before it
  constexpr double straight_m = 100;    // some turns of a small fixed wing
  const auto entry = *position_of(mission_.items[begin]);
  const auto end = position_of(mission_.items[index_]);
  const auto* const line = line_of_item();
  const auto done_m =
      line != nullptr && end ? way_along(point_of(entry), point_of(*end), point_of(line->at)) : std::optional<double>();
  const auto go_to = [&](double along_m) {
    const auto there = along_m > 0 ? place_along(entry, *end, along_m) : entry;
    writer_.cruise_to(there);
    writer_.add_nav(waypoint_item(there, 0, is(vehicle_class::fixed_wing) ? 0 : accept_radius_m, setting_));
  };
  if (done_m && is(vehicle_class::fixed_wing))
    go_to(*done_m - straight_m);
  go_to(done_m.value_or(0));
  if (done_m)
    writer_.continue_line(line->pictures);
  return done_m.has_value();
}

// What the commands before the rest have set, each as it was. A camera that was triggering goes on where its last
// picture was taken: nothing of the line is missing, and no picture is made on the way there.
void item_planner::repeat_state() {
  has_repeated_ = true;
  for (const auto index : state_before(mission_, index_)) {
    if (index >= *rest_from_)
      continue; // in the plan itself
    const auto& command = std::get<mission::command_item>(mission_.items[index]);
    if (answer_to(command) != item_answer::taken)
      continue;
    const auto line = mission::state_of(command) == mission::command_state::trigger ? waypoint_before(mission_, index_)
                                                                                    : std::nullopt;
    const bool has_entry = line && position_of(mission_.items[*line]);
    const bool goes_on = has_entry && lead_in_to_line(*line);
    const auto* const from = goes_on     ? ", from the last picture of its line on."
                             : has_entry ? ", from the beginning of its line on."
                                         : ".";
    writer_.repeat(command_item_of(command, setting_));
    writer_.note("Before item '" + mission::id_of(mission_.items[index_]) + "' " + name_of(command) + " of item '" +
                 command.id + "' is repeated" + from);
  }
}

} // namespace godwit::executor::plan
