#include "actors/ground_port/state.hpp"

#include <algorithm>
#include <bit>

#include "io/mavlink/enums.hpp"

namespace godwit::ground_port {

namespace {

using effects = std::vector<durable_core::effect>;

effects decide(state& s, const signing_time_reserved& what, std::int64_t) {
  s.signing_ceiling = std::max(s.signing_ceiling, what.ceiling);
  return {what};
}

effects decide(state& s, const plan_noted& what, std::int64_t now_ns) {
  std::erase_if(s.plans, [&](const kept_plan& each) { return each.type == what.type; });
  if (!what.items.empty())
    s.plans.push_back({what.type, what.plan_id, what.items});
  if (what.type == io::mavlink::mav_mission_type::mission)
    s.start_item = what.start_item;
  if (what.type == io::mavlink::mav_mission_type::mission && !what.from_executor)
    note_view(s.views, {what.by, what.items.empty() ? 0 : what.plan_id});
  effects result;
  if (!what.from_executor && what.items.empty())
    result.emplace_back(executor::plan_cleared{what.type, what.by});
  else if (!what.from_executor)
    result.emplace_back(executor::plan_taken{what.type, what.plan_id, restore(what.items), what.by});
  result.emplace_back(plan_resolved{what.ticket, what.ack, now_ns, what.type, what.items.empty() ? 0 : what.plan_id});
  return result;
}

effects decide(state& s, const start_noted& what, std::int64_t) {
  s.last_start = what.record;
  if (what.record.is_resolved) {
    if (what.record.result == io::mavlink::number(io::mavlink::mav_result::accepted))
      s.start_item.reset(); // it is used up
    return {start_resolved{what.record}};
  }
  return {what.record.asked};
}

effects decide(state& s, const start_item_noted& what, std::int64_t now_ns) {
  s.start_item = what.index;
  return {start_item_resolved{what.ticket, what.index, what.ack, now_ns}};
}

} // namespace

void note_view(std::vector<plan_view>& among, const plan_view& what) {
  std::erase_if(among, [&](const plan_view& each) { return each.by == what.by; });
  if (among.size() == max_plan_views)
    among.erase(among.begin());
  among.push_back(what);
}

effects durable_core::apply(state& s, const event& happened, std::int64_t now_ns) {
  return std::visit([&](const auto& each) { return decide(s, each, now_ns); }, happened);
}

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
