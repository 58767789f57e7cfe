#include "actors/executor/preflight/checks/return_point.hpp"

namespace godwit::executor::preflight {

result look_at_return_point(const facts& seen, const settings&) {
  const auto& now = seen.mission;
  if (now.document == nullptr)
    return skipped("There is no mission whose return point could be looked at.");
  if (!now.document->return_point)
    return skipped("The mission has no return point of its own.");
  if (now.document->geofences.empty())
    return skipped("The mission has no fences.");
  if (!now.return_point)
    return fail("The return point was not compared with the fences yet; wait.");
  if (!now.return_point->empty())
    return fail(now.return_point->front().message + " Change the return point or the fences.");
  return pass("The return point keeps to the fences.");
}

} // namespace godwit::executor::preflight
