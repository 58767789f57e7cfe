#include "actors/domain/mission/item_rules.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>

#include "actors/domain/mission/commands/item_class.hpp"
#include "actors/domain/mission/polygon_rules.hpp"
#include "actors/domain/mission/rules.hpp"
#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"
#include "io/mavlink/frame_meaning.hpp"

namespace godwit::mission {

namespace {

using problems_list = std::vector<document_problem>;

// A number that JSON does not know came from our own hands; a vehicle must never see it.
template <class V>
void add_unless_finite(const V& value, const std::string& pointer, problems_list& problems) {
  if constexpr (io::has_fields<V>) {
    io::for_each_field<V>(
        [&](const auto& entry) { add_unless_finite(value.*entry.member, pointer_to(pointer, entry.name), problems); });
  } else if constexpr (io::is_optional<V>::value) {
    if (value)
      add_unless_finite(*value, pointer, problems);
  } else if constexpr (io::is_vector<V>::value || io::is_std_array<V>::value) {
    for (std::size_t i = 0; i < value.size(); ++i)
      add_unless_finite(value[i], pointer_to(pointer, i), problems);
  } else if constexpr (std::is_floating_point_v<V>) {
    if (!std::isfinite(value))
      problems.push_back({pointer, "is no finite number", {}});
  }
}

void add_repeated_ids(std::span<const item> items, const std::string& pointer, problems_list& problems) {
  std::map<std::string_view, std::size_t> first;
  for (std::size_t i = 0; i < items.size(); ++i)
    if (const auto [found, is_new] = first.emplace(id_of(items[i]), i); !is_new)
      problems.push_back({pointer_to(pointer_to(pointer, i), "id"),
                          "is " + in_quotes(id_of(items[i])) + ", as of item " + std::to_string(found->second),
                          "an id that no other item has"});
}

// In a frame with degrees, of a command that has a place.
void add_command_place(const command_item& each, const std::string& pointer, problems_list& problems) {
  if (!has_place(each) || io::mavlink::coordinates_of(each.frame) != io::mavlink::coordinate_kind::global)
    return;
  constexpr int limits[] = {90, 180};
  for (std::size_t i = 0; i < std::size(limits); ++i) {
    const auto& value = each.params[latitude_param + i];
    if (!value || !(std::abs(*value) > limits[i]))
      continue;
    std::string number;
    io::append_json_number(number, *value);
    const auto limit = std::to_string(limits[i]);
    problems.push_back({pointer_to(pointer_to(pointer, "params"), latitude_param + i), "is " + number,
                        "a number from -" + limit + " to " + limit});
  }
}

// What is wrong with the jump at INDEX, and what would be right; nothing: it is sound.
std::optional<document_problem> jump_fault(std::span<const item> items, std::size_t index, const jump& each) {
  const auto to = index_of(items, each.to);
  if (!to)
    return document_problem{{}, "is " + in_quotes(each.to) + ", which no item is called", "the id of an item"};
  if (*to == index)
    return document_problem{{}, "leads to itself", "the id of another item"};
  const bool is_endless = each.times < 0 && *to < index;
  if (is_endless && std::none_of(items.begin() + static_cast<std::ptrdiff_t>(*to),
                                 items.begin() + static_cast<std::ptrdiff_t>(index), moves_vehicle))
    return document_problem{
        {}, "leads back for ever, and no item in between moves the vehicle", "an item that moves it"};
  return std::nullopt;
}

void add_polygon_problems(std::span<const vertex> corners, const std::string& pointer, problems_list& problems) {
  if (auto fault = polygon_fault(corners))
    problems.push_back({pointer, std::move(*fault), "at least 3 different corners, edges that do not cross or touch"});
}

} // namespace

void add_jump_problems(std::span<const item> items, const std::string& pointer, problems_list& problems) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (const auto* each = std::get_if<jump>(&items[i]))
      if (auto fault = jump_fault(items, i, *each)) {
        fault->pointer = pointer_to(pointer_to(pointer, i), "to");
        problems.push_back(*std::move(fault));
      }
}

void add_position_problems(const position& place, const std::string& pointer, problems_list& problems) {
  add_unless_finite(place, pointer, problems);
}

void add_position_problems(const planned_home& place, const std::string& pointer, problems_list& problems) {
  add_unless_finite(place, pointer, problems);
}

void add_item_problems(std::span<const item> items, const std::string& pointer, problems_list& problems) {
  add_repeated_ids(items, pointer, problems);
  std::size_t corners = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto here = pointer_to(pointer, i);
    std::visit([&](const auto& each) { add_unless_finite(each, here, problems); }, items[i]);
    if (const auto* command = std::get_if<command_item>(&items[i]))
      add_command_place(*command, here, problems);
    if (const auto* area = std::get_if<survey>(&items[i])) {
      if (area->camera && area->camera->trigger.distance_m.has_value() == area->camera->trigger.interval_s.has_value())
        problems.push_back({pointer_to(pointer_to(here, "camera"), "trigger"),
                            area->camera->trigger.distance_m ? "has `distance_m` and `interval_s`" : "has neither",
                            "`distance_m` or `interval_s`"});
      corners += area->polygon.size();
      if (corners <= max_corners_in_mission)
        add_polygon_problems(area->polygon, pointer_to(here, "polygon"), problems);
    }
  }
  if (corners > max_corners_in_mission)
    problems.push_back({pointer, "have polygons with " + std::to_string(corners) + " corners in all",
                        "up to " + std::to_string(max_corners_in_mission)});
}

} // namespace godwit::mission
