#include "actors/executor/plan/builder.hpp"

#include "actors/executor/plan/item_planner.hpp"
#include "actors/executor/plan/mission_look.hpp"
#include "actors/executor/plan/plan_writer.hpp"

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
  for (auto i = from.item_index; i < count; ++i) {
    if (writers.back().ends_on_ground())
      writers.push_back(writer_behind(writers.back(), setting));
    item_planner planner(mission, setting, writers.back());
    if (const auto altitude_m = take_off_before(mission, i);
        altitude_m && i == from.item_index && !setting.is_under_way && setting.vehicle == vehicle_class::multirotor)
      planner.take_off_again(*altitude_m);
    if (auto problem = planner.write(i, i == from.item_index ? from.lines_before : 0))
      return failure(*std::move(problem));
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
  std::vector<flight_plan> plans;
  for (const auto& each : writers)
    plans.push_back(each.finished());
  plans.back().map.ends_mission = true;
  return plans;
}

} // namespace godwit::executor::plan
