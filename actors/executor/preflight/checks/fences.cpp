#include "actors/executor/preflight/checks/fences.hpp"

#include <string>
#include <vector>

namespace godwit::executor::preflight {

namespace {

std::vector<std::string> messages_of(const std::vector<plan::violation>& all) {
  std::vector<std::string> result;
  for (const auto& each : all)
    result.push_back(each.message);
  return result;
}

} // namespace

result look_at_fences(const facts& seen, const settings&) {
  const auto& now = seen.mission;
  if (now.document == nullptr || now.plans == nullptr || !*now.plans)
    return skipped("There is no way that could be compared with the fences.");
  if (now.document->geofences.empty())
    return skipped("The mission has no fences.");
  if (!now.way)
    return fail("The way of the mission was not compared with its fences yet; wait.");
  if (!now.way->empty())
    return fail("The mission does not keep to its fences; change it or them. " + summary_of(messages_of(*now.way)));
  return pass("The way of the mission keeps to its fences.");
}

} // namespace godwit::executor::preflight
