#include "actors/executor/plan/builder.hpp"

#include <algorithm>
#include <optional>

#include "actors/domain/mission/commands/item_class.hpp"
#include "actors/executor/plan/item_planner.hpp"
#include "actors/executor/plan/loop_rest.hpp"
#include "actors/executor/plan/mission_look.hpp"
#include "actors/executor/plan/plan_writer.hpp"
#include "actors/executor/plan/vehicle_items.hpp"

namespace godwit::executor::plan {

namespace {

using failure = tl::unexpected<plan_error>;

plan_error too_many_items(const mission::document& mission, std::size_t index) {
  return {plan_errc::too_many_items, index, mission::id_of(mission.items[index]),
          "With it the plan has more than " + std::to_string(max_plan_items) + " vehicle items",
          "put a land in between, or the lines of surveys farther apart"};
}

plan_writer writer_behind(const plan_writer& done, const plan_setting& setting) {
  return {setting, done.here(), false, done.speed_mps()};
}

// After a landing: what a mission holds that came as commands is flown next only if it begins with a take-off. All
// else is kept for a failure, or for another approach; on ArduPilot, whose mission ends with a landing. What a PX4 does
// with it was not seen, and so it has none.
bool begins_branch(const mission::document& mission, std::size_t index, const plan_setting& setting) {
  if (!is_ardupilot(setting) || !std::ranges::any_of(mission.items, mission::is_of_version_2))
    return false;
  const auto next = std::find_if(mission.items.begin() + static_cast<std::ptrdiff_t>(index), mission.items.end(),
                                 mission::moves_vehicle);
  return next != mission.items.end() && !mission::is_take_off(*next);
}

// A jump to what is not in its plan.
std::optional<plan_error> lost_target(const mission::document& mission, std::size_t first,
                                      const std::vector<plan_writer>& writers) {
  for (const auto& each : writers)
    if (const auto target = each.missing_target()) {
      const auto jump = std::ranges::find_if(mission.items, [&](const mission::item& item) {
        const auto* const found = std::get_if<mission::jump>(&item);
        return found != nullptr && found->to == *target;
      });
      return jump_left_out(mission, first, static_cast<std::size_t>(jump - mission.items.begin()));
    }
  return std::nullopt;
}

// A multirotor that stands on the ground in the middle of the mission.
std::optional<double> takes_off_again(const mission::document& mission, const plan_setting& setting, std::size_t from) {
  return setting.is_under_way || setting.vehicle != vehicle_class::multirotor ? std::nullopt
                                                                              : take_off_before(mission, from);
}

} // namespace

tl::expected<std::vector<flight_plan>, plan_error> build_plans(const mission::document& mission,
                                                               const plan_setting& setting, const plan_from& from) {
  const auto count = mission.items.size();
  if (setting.vehicle == vehicle_class::unknown)
    return failure({plan_errc::unknown_vehicle,
                    from.item_index,
                    {},
                    "It is not known whether it is for a multirotor, a fixed wing or a rover",
                    "wait for the heartbeat of the vehicle; other kinds fly no missions"});
  if (from.item_index >= count)
    return failure(
        {plan_errc::no_such_item,
         from.item_index,
         {},
         "It has " + std::to_string(count) + " items, and none with index " + std::to_string(from.item_index),
         "begin with an item that it has"});
  std::vector<plan_writer> writers;
  writers.emplace_back(setting, setting.start, setting.is_under_way, speed_before(mission, from.item_index));
  const auto begin = loop_begin(mission, from.item_index);
  if (auto problem = uncounted_jump(mission, begin, from, setting))
    return failure(*std::move(problem));
  if (begin < from.item_index) {
    item_planner planner(mission, setting, writers.back());
    planner.repeat_state_of(from.item_index);
    if (const auto altitude_m = takes_off_again(mission, setting, from.item_index))
      planner.take_off_again(*altitude_m);
    if (auto problem = planner.lead_in(from.item_index))
      return failure(*std::move(problem));
  }
  bool owes_state = from.item_index > 0 && begin == from.item_index;
  for (auto i = begin; i < count; ++i) {
    if (writers.back().ends_on_ground() && !writers.back().is_branch() && begins_branch(mission, i, setting))
      writers.back().begin_branch();
    else if (writers.back().ends_on_ground() && (!writers.back().is_branch() || mission::is_take_off(mission.items[i])))
      writers.push_back(writer_behind(writers.back(), setting));
    item_planner planner(mission, setting, writers.back());
    planner.count_jumps(from.jumps);
    const bool is_first = i == from.item_index && begin == i;
    if (owes_state)
      planner.repeat_state_of(from.item_index);
    if (from.line && (owes_state || is_first))
      planner.continue_line(*from.line);
    if (const auto altitude_m = is_first ? takes_off_again(mission, setting, i) : std::nullopt)
      planner.take_off_again(*altitude_m);
    if (auto problem = planner.write(i, is_first ? from.lines_before : 0))
      return failure(*std::move(problem));
    owes_state = owes_state && !planner.has_repeated_state();
    if (writers.back().size() > max_plan_items)
      return failure(too_many_items(mission, i));
  }
  if (!writers.back().has_moved() && writers.size() > 1) {
    const auto idle = writers.back().map();
    writers.pop_back();
    writers.back().take_over(idle);
  }
  if (!writers.back().has_moved())
    return failure({plan_errc::nothing_to_fly,
                    from.item_index,
                    {},
                    "No item of it moves the vehicle",
                    "give it a place to go to"});
  if (auto problem = lost_target(mission, from.item_index, writers))
    return failure(*std::move(problem));
  std::vector<flight_plan> plans;
  for (const auto& each : writers)
    plans.push_back(each.finished());
  plans.back().map.ends_mission = true;
  return plans;
}

} // namespace godwit::executor::plan
