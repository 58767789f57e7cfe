#include "actors/ground_port/kept_item.hpp"

#include <bit>

namespace godwit::ground_port {

std::vector<kept_item> keep(const std::vector<io::mavlink::mission_item_int>& items) {
  std::vector<kept_item> result;
  result.reserve(items.size());
  for (const auto& each : items) {
    const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
    result.push_back(
        {.command = each.command,
         .frame = each.frame,
         .current = each.current,
         .autocontinue = each.autocontinue,
         .mission_type = each.mission_type,
         .x = each.x,
         .y = each.y,
         .float_bits = {bits(each.param1), bits(each.param2), bits(each.param3), bits(each.param4), bits(each.z)}});
  }
  return result;
}

std::vector<io::mavlink::mission_item_int> restore(const std::vector<kept_item>& items) {
  std::vector<io::mavlink::mission_item_int> result;
  result.reserve(items.size());
  for (const auto& each : items) {
    io::mavlink::mission_item_int item;
    item.seq = static_cast<std::uint16_t>(result.size());
    item.command = each.command;
    item.frame = each.frame;
    item.current = each.current;
    item.autocontinue = each.autocontinue;
    item.mission_type = each.mission_type;
    item.x = each.x;
    item.y = each.y;
    item.param1 = std::bit_cast<float>(each.float_bits[0]);
    item.param2 = std::bit_cast<float>(each.float_bits[1]);
    item.param3 = std::bit_cast<float>(each.float_bits[2]);
    item.param4 = std::bit_cast<float>(each.float_bits[3]);
    item.z = std::bit_cast<float>(each.float_bits[4]);
    result.push_back(item);
  }
  return result;
}

} // namespace godwit::ground_port
