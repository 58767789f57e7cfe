// Of the mission, its plan and its way home.
#include "actors/executor/preflight/checks.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "actors/domain/geo/distance_text.hpp"
#include "actors/domain/geofence/fence_name.hpp"
#include "actors/domain/mission/polygon_rules.hpp"

namespace godwit::executor::preflight {

result check_mission(const facts& seen, const settings&) {
  const auto& now = seen.mission;
  if (now.document == nullptr)
    return now.refusal.empty() ? fail("No mission is loaded; upload one, or ask the missions service for one.")
                               : fail("No mission is loaded: " + now.refusal);
  if (now.is_deleted)
    return fail("The missions service has deleted this mission; give the vehicle another one.");
  if (now.plans == nullptr)
    return fail("The mission is loaded and not planned yet; it is as soon as the vehicle reports where it is.");
  if (!*now.plans)
    return fail("The mission can not be flown by this vehicle. " + now.plans->error().message());
  if (now.plans->value().empty())
    return fail("The mission has nothing to fly; put a place into it.");
  return pass("The mission is loaded and can be flown (items: " + std::to_string(now.document->items.size()) +
              ", plans: " + std::to_string(now.plans->value().size()) + ").");
}

result check_places(const facts& seen, const settings&) {
  const auto& now = seen.mission;
  if (now.document == nullptr)
    return skipped("There is no mission whose places could be compared with home.");
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: whether the mission lies near its home is not known.");
  if (!now.out_of_limits)
    return fail("The places of the mission were not compared with home yet; they are as soon as the vehicle reports "
                "where it is and where its home is.");
  if (!now.out_of_limits->empty())
    return fail("The mission is not for this place, or is wrong; correct it, or set the limit. " +
                summary_of(*now.out_of_limits));
  return pass("All places of the mission are within the limits around home.");
}

result check_planned_home(const facts& seen, const settings&) {
  const auto& now = seen.mission;
  if (now.document == nullptr || !now.document->planned_home)
    return skipped("No mission with a planned home is loaded.");
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: how far its home is from the planned one is not known.");
  if (!now.planned_home)
    return fail("The planned home of the mission was not compared with the vehicle's home yet; it is as soon as the "
                "vehicle reports where it is and where its home is.");
  const auto away = geo::distance_text(now.planned_home->away_m);
  if (now.planned_home->away_m < far_from_planned_home_m)
    return pass("The planned home of the mission is " + away + " from the vehicle's home.");
  return degraded("The planned home of the mission is " + away + ' ' +
                  std::string(geo::direction_text(now.planned_home->bearing_deg)) +
                  " of the vehicle's home. Nothing flies there: returns lead to the vehicle's home. Check that the "
                  "mission is for this place.");
}

namespace {

std::vector<std::string> messages_of(const std::vector<plan::violation>& all) {
  std::vector<std::string> result;
  for (const auto& each : all)
    result.push_back(each.message);
  return result;
}

} // namespace

result check_fences(const facts& seen, const settings&) {
  const auto& now = seen.mission;
  if (now.document == nullptr || now.plans == nullptr || !*now.plans)
    return skipped("There is no way that could be compared with the fences.");
  if (now.document->geofences.empty())
    return skipped("The mission has no fences.");
  if (!now.way)
    return fail("The way of the mission was not compared with its fences yet; wait.");
  if (!now.way->empty())
    return fail("The mission does not keep to its fences; change it or them. " + summary_of(messages_of(*now.way)));
  for (std::size_t i = 0; i < now.document->geofences.size(); ++i)
    if (const auto fault = mission::polygon_fault(now.document->geofences[i].vertices))
      return degraded("The way of the mission keeps to its fences, but " + geofence::fence_name(i) + ' ' + *fault +
                      ". As for the vehicle, places around which it runs an even number of times are outside of it. "
                      "Check that this is meant.");
  return pass("The way of the mission keeps to its fences.");
}

result check_return_point(const facts& seen, const settings&) {
  const auto& now = seen.mission;
  if (now.document == nullptr)
    return skipped("There is no mission whose return point could be checked.");
  if (!now.document->return_point)
    return skipped("The mission has no return point of its own.");
  if (now.document->geofences.empty())
    return skipped("The mission has no fences.");
  if (!now.return_point)
    return fail("The return point was not compared with the fences yet; wait.");
  if (!now.return_point->empty())
    return fail(now.return_point->front().message + " Change the return point or the fences.");
  return pass("The return point keeps to the fences.");
}

namespace {

// "'w1', 'w2' and 3 more"
std::string names_of(const std::vector<plan::return_crossing>& all, const mission::document& mission) {
  std::vector<std::uint32_t> items;
  for (const auto& each : all)
    if (std::ranges::find(items, each.item_index) == items.end())
      items.push_back(each.item_index);
  const auto named = std::min(items.size(), max_named_items);
  std::string result;
  for (std::size_t i = 0; i < named; ++i)
    result += (i == 0 ? "'" : ", '") + mission::id_of(mission.items.at(items[i])) + "'";
  return named == items.size() ? result : result + " and " + std::to_string(items.size() - named) + " more";
}

} // namespace

std::string crossing_sentence(const std::vector<plan::return_crossing>& all, const mission::document& mission) {
  return "The return of a failsafe is straight, and leads into " + geofence::fence_name(all.front().fence) +
         " from the way to item " + names_of(all, mission) + ".";
}

result check_straight_return(const facts& seen, const settings& set) {
  const auto& now = seen.mission;
  if (now.document == nullptr || now.plans == nullptr || !*now.plans)
    return skipped("There is no path from which a return could be checked.");
  if (now.document->geofences.empty())
    return skipped("The mission has no fences.");
  if (!now.straight_return)
    return fail("The straight returns of the mission were not compared with its fences yet; wait.");
  if (now.straight_return->empty())
    return pass("A failsafe's straight return crosses no exclusion fence.");
  auto sentence = crossing_sentence(*now.straight_return, *now.document);
  if (!set.asks_for_straight_return)
    return pass(std::move(sentence));
  return degraded(sentence + " Move these items or the fence, or acknowledge that it flies there.");
}

result check_energy(const facts& seen, const settings& set) {
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: whether its battery lasts is not known.");
  if (!seen.mission.spare_percent)
    return skipped("How fast the battery drains is not known, so nobody has looked whether it lasts for the plan and "
                   "the way home; set flight.drain_percent_per_min.");
  const auto spare = *seen.mission.spare_percent;
  const bool is_critical = spare < set.battery_critical_percent - set.battery_return_percent;
  const auto reserve = std::to_string(set.battery_return_percent) + " % at which the failsafe returns";
  if (spare < 0 && set.starts_by_itself && !is_critical)
    return pass("By its drain the battery lasts for the plan, and the failsafe returns it on the way, at " +
                std::to_string(set.battery_return_percent) +
                " %: nobody is asked, because flights begin by themselves.");
  if (spare < 0)
    return degraded("By its drain the battery does not last for the plan and the way home above the " + reserve +
                    "; put in a charged one, or shorten the mission.");
  return pass("By its drain the battery lasts for the plan and the way home above the " + reserve + ".");
}

} // namespace godwit::executor::preflight
