#include "actors/executor/progress/plan_map.hpp"

#include <algorithm>

#include "runtime/assert.hpp"

namespace godwit::executor::progress {

namespace {

std::uint32_t end_of(const mapped_item& item) { return std::uint32_t{item.first_sequence} + item.sequence_count; }

bool has_sound_movements(const mapped_item& item) {
  if (item.first_nav_sequence.has_value() != item.last_nav_sequence.has_value())
    return false;
  return !item.first_nav_sequence ||
         (*item.first_nav_sequence >= item.first_sequence && *item.first_nav_sequence <= *item.last_nav_sequence &&
          *item.last_nav_sequence < end_of(item));
}

} // namespace

bool is_sound(const plan_map& map) {
  const auto end = std::uint32_t{map.first_sequence} + map.total;
  if (map.items.size() > max_mapped_items || map.total == 0 || end > no_sequence)
    return false;
  if (!has_sequence(map, map.start_sequence))
    return false;
  std::uint32_t free_from = map.first_sequence;
  for (std::size_t i = 0; i < map.items.size(); ++i) {
    const auto& item = map.items[i];
    if (i > 0 && item.item_index <= map.items[i - 1].item_index)
      return false;
    if (item.first_sequence < free_from || end_of(item) > end || !has_sound_movements(item))
      return false;
    free_from = end_of(item);
  }
  if (map.items_before > map.items.size() || (map.enters_at && !has_sequence(map, *map.enters_at)))
    return false;
  return std::ranges::all_of(map.loops, [&](const plan_loop& each) {
    return has_sequence(map, each.target_sequence) && has_sequence(map, each.jump_sequence) &&
           each.target_sequence < each.jump_sequence;
  });
}

std::uint16_t end_sequence(const plan_map& map) { return static_cast<std::uint16_t>(map.first_sequence + map.total); }

bool has_sequence(const plan_map& map, std::uint16_t sequence) {
  return sequence >= map.first_sequence && sequence < end_sequence(map);
}

std::optional<std::uint16_t> last_movement(const plan_map& map) {
  const auto items = items_to_finish(map);
  return items == 0 ? std::nullopt : map.items[items - 1].last_nav_sequence;
}

std::optional<std::uint32_t> position_at(const plan_map& map, std::uint16_t sequence) {
  const auto found = std::partition_point(map.items.begin(), map.items.end(),
                                          [&](const mapped_item& each) { return end_of(each) <= sequence; });
  if (found == map.items.end() || found->first_sequence > sequence)
    return std::nullopt;
  return static_cast<std::uint32_t>(found - map.items.begin());
}

std::uint16_t done_sequence(const mapped_item& item) {
  GODWIT_ASSERT(item.sequence_count > 0, "an item without vehicle items is not done at a sequence");
  return item.last_nav_sequence.value_or(static_cast<std::uint16_t>(end_of(item) - 1));
}

bool is_passed(const mapped_item& item, std::uint16_t sequence) {
  return item.sequence_count == 0 ? item.first_sequence <= sequence : done_sequence(item) < sequence;
}

bool is_in_lead_in(const plan_map& map, std::uint16_t start) {
  return map.enters_at && start < map.items.front().first_sequence;
}

bool is_start(const plan_map& map, std::uint16_t start, std::uint16_t sequence) {
  if (is_in_lead_in(map, start)) {
    if (sequence >= start && sequence < map.items.front().first_sequence)
      return true;
    start = *map.enters_at;
  }
  if (sequence == start)
    return true;
  const auto moving = std::find_if(map.items.begin(), map.items.end(), [&](const mapped_item& each) {
    return each.last_nav_sequence && *each.last_nav_sequence >= start;
  });
  return moving != map.items.end() && sequence > start && sequence <= *moving->first_nav_sequence;
}

std::optional<plan_loop> loop_between(const plan_map& map, std::uint16_t at, std::uint16_t sequence) {
  std::optional<plan_loop> found;
  for (const auto& each : map.loops)
    if (each.target_sequence <= sequence && sequence < at && at <= each.jump_sequence &&
        (!found || each.jump_sequence < found->jump_sequence))
      found = each;
  return found;
}

bool ends_in_loop(const plan_map& map) {
  const auto last = last_movement(map);
  return last && std::ranges::any_of(map.loops, [&](const plan_loop& each) { return each.jump_sequence > *last; });
}

std::uint32_t items_to_finish(const plan_map& map) {
  const auto last = std::find_if(map.items.rbegin(), map.items.rend(),
                                 [](const mapped_item& each) { return each.last_nav_sequence.has_value(); });
  return static_cast<std::uint32_t>(last == map.items.rend() ? map.items.size() : map.items.rend() - last);
}

} // namespace godwit::executor::progress
