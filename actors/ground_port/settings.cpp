#include "actors/ground_port/settings.hpp"

#include "actors/ground_port/passing/table.hpp"

namespace godwit::ground_port {

std::vector<forward_rate> default_rates() {
  return {{mavlink::global_position_int::message_id, 250},
          {mavlink::attitude::message_id, 250},
          {mavlink::vfr_hud::message_id, 250},
          {mavlink::battery_status::message_id, 1'000},
          {mavlink::sys_status::message_id, 1'000}};
}

std::optional<std::string> objection_to(const settings& given) {
  if (given.as.system == 0)
    return "system 0 means all systems; give the port the vehicle's system id";
  if (given.as.component == 0)
    return "component 0 means all components; give the port one of its own (191), or 1 to stand in for the autopilot";
  if (stands_in_for_autopilot(given.as) && given.autopilot_is_on_this_line)
    return "component 1 is the autopilot's own on this line; give the port another one (191)";
  if (given.heartbeat_ms <= 0)
    return "the heartbeat needs an interval above 0";
  if (given.max_items <= 0 || given.max_items > max_plan_items)
    return "a plan has 1 to " + std::to_string(max_plan_items) + " items";
  for (const auto& each : given.also_passes)
    if (!passing::is_for_setting(each))
      return "nothing is passed on under the name " + each;
  return std::nullopt;
}

} // namespace godwit::ground_port
