#include "actors/domain/mission/item_rules.hpp"

#include <cmath>
#include <map>
#include <string_view>

#include "actors/domain/mission/polygon_rules.hpp"
#include "actors/domain/mission/rules.hpp"
#include "io/fields/json_value.hpp"

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
  } else if constexpr (io::is_vector<V>::value) {
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

} // namespace

void add_polygon_problems(std::span<const vertex> corners, const std::string& pointer, problems_list& problems) {
  if (auto fault = polygon_fault(corners))
    problems.push_back({pointer, std::move(*fault), "at least 3 different corners, edges that do not cross or touch"});
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
    if (const auto* area = std::get_if<survey>(&items[i])) {
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
