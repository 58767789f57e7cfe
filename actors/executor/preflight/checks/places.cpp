#include "actors/executor/preflight/checks/places.hpp"

namespace godwit::executor::preflight {

result look_at_places(const facts& seen, const settings&) {
  const auto& now = seen.mission;
  if (now.document == nullptr)
    return skipped("There is no mission whose places could be compared with home.");
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: whether the mission lies near its home is not known.");
  if (!now.out_of_limits)
    return fail("The places of the mission were not compared with home yet; they are as soon as the vehicle reports "
                "where it is and where its home is.");
  if (!now.out_of_limits->empty())
    return fail("The mission is not for this place, or is wrong; correct it, or set the limit. " +
                summary_of(*now.out_of_limits));
  return pass("All places of the mission are within the limits around home.");
}

} // namespace godwit::executor::preflight
