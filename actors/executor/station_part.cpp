#include "actors/executor/station_part.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "actors/domain/mission/commands/item_class.hpp"
#include "actors/domain/mission/convert/conversion.hpp"
#include "actors/domain/mission/version.hpp"
#include "actors/domain/uuid/uuid.hpp"
#include "actors/executor/station_plan.hpp"

namespace godwit::executor {
namespace {

using mission::is_take_off;

// What comes before the first movement is no movement.
bool begins_with_take_off(const std::vector<mission::item>& items) {
  const auto moves = std::ranges::find_if(items, mission::moves_vehicle);
  return moves != items.end() && is_take_off(*moves);
}

} // namespace

std::string new_mission_id(std::uint32_t plan_id, std::int64_t wall_ns) {
  return mission::uuid_of_text("a ground station's plan " + std::to_string(plan_id) + " at " + std::to_string(wall_ns));
}

item_range whole_plan(const state& s) { return {0, static_cast<std::uint16_t>(s.station->items - 1)}; }

item_range chosen_part(const state& s) {
  return s.station->part ? item_range{s.station->part->first, s.station->part->last} : whole_plan(s);
}

std::optional<station_plan_taken> part_of_plan(const state& s, const item_range& wanted, bool takes_off) {
  const auto* const uploaded = uploaded_mission(s);
  if (uploaded == nullptr)
    return std::nullopt;
  const auto& part = s.station->part;
  const auto& whole = part ? part->whole : *uploaded;
  const auto& places = part ? part->places : s.station->places;
  station_plan_taken result{*s.station, whole};
  result.mission.mission_id = uploaded->mission_id;
  result.mission.revision = uploaded->revision;
  auto& items = result.mission.items;
  items.clear();
  result.plan.places.clear();
  std::optional<std::size_t> take_off;
  for (std::size_t i = 0; i < whole.items.size() && i < places.size(); ++i) {
    if (places[i] < wanted.first && is_take_off(whole.items[i]))
      take_off = i;
    if (places[i] < wanted.first || places[i] > wanted.last)
      continue;
    items.push_back(whole.items[i]);
    result.plan.places.push_back(places[i]);
  }
  if (takes_off && take_off && !begins_with_take_off(items)) {
    items.insert(items.begin(), whole.items[*take_off]);
    result.plan.places.insert(result.plan.places.begin(), places[*take_off]);
  }
  mission::put_fences(result.mission, s.station_fences, s.station_breach_return_point);
  const bool is_whole = wanted.first == 0 && wanted.last + 1 >= s.station->items;
  result.plan.part = is_whole ? std::nullopt : std::optional(station_part{wanted.first, wanted.last, whole, places});
  return result;
}

std::size_t first_item_at(const station_plan_taken& part, std::uint16_t place) {
  const auto& places = part.plan.places;
  return static_cast<std::size_t>(std::ranges::find_if(places, [&](auto each) { return each >= place; }) -
                                  places.begin());
}

station_plan_taken as_new_mission(station_plan_taken what, std::int64_t wall_ns) {
  what.plan.mission_id = new_mission_id(what.plan.plan_id, wall_ns);
  what.plan.revision = 1;
  what.mission.mission_id = what.plan.mission_id;
  what.mission.revision = what.plan.revision;
  return what;
}

std::string sentence_of(const item_range& part, std::uint16_t items) {
  return "items " + std::to_string(part.first) + " to " + std::to_string(part.last) + " of " + std::to_string(items);
}

} // namespace godwit::executor
