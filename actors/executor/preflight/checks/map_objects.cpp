#include "actors/executor/preflight/checks/map_objects.hpp"

namespace godwit::executor::preflight {

result look_at_map_objects(const facts& seen, const settings&) {
  using mission_client::pull_state;
  const auto& now = seen.mission;
  if (!now.has_service)
    return skipped("The mission did not come from the missions service: there is no map for it.");
  switch (now.map) {
  case pull_state::synced:
    return pass("The objects of the map are pulled.");
  case pull_state::cached_fallback:
    return degraded(
        "The objects of the map could not be pulled, and a copy from before is used: what was seen since then "
        "is not in it. godwit pulls again by itself, and at once with `godwitd ctl pull`; or fly with the copy.");
  case pull_state::in_flight:
    return fail("The objects of the map are being pulled; wait." +
                (now.map_problem.empty() ? "" : " Before: " + now.map_problem));
  case pull_state::failed:
    return fail("The objects of the map could not be pulled, and there is no copy from before; look at the connection "
                "to the missions service. godwit pulls again by itself, and at once with `godwitd ctl pull`." +
                (now.map_problem.empty() ? "" : " " + now.map_problem));
  case pull_state::not_started:
    break;
  }
  return fail("The objects of the map are not pulled yet; wait until the mission is fetched.");
}

} // namespace godwit::executor::preflight
