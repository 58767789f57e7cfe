#include "actors/executor/preflight/checks/straight_return.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "actors/domain/geofence/fence_name.hpp"

namespace godwit::executor::preflight {
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

result look_at_straight_return(const facts& seen, const settings& set) {
  const auto& now = seen.mission;
  if (now.document == nullptr || now.plans == nullptr || !*now.plans)
    return skipped("There is no way from which a return could be looked at.");
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

} // namespace godwit::executor::preflight
