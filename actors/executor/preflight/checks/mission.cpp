#include "actors/executor/preflight/checks/mission.hpp"

#include <string>

namespace godwit::executor::preflight {

result look_at_mission(const facts& seen, const settings&) {
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

} // namespace godwit::executor::preflight
