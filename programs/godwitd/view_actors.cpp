#include "programs/godwitd/view_actors.hpp"

#include "actors/health/actor.hpp"
#include "programs/godwitd/child_policies.hpp"

namespace godwit::daemon {

view_actors add_views(runtime::system& actors, const view_surroundings& outside, const base_actors& base,
                      const flight_actors& flight) {
  view_actors made;
  const auto of_health = std::make_shared<health::peers>();
  of_health->guardian = actors.guardian();
  of_health->flight = flight.executor;
  of_health->failsafe = base.failsafe;
  of_health->vehicle = base.vehicle;
  of_health->ground = flight.ground;
  of_health->service = base.client;
  of_health->map = base.store;
  made.health = actors.add<health::actor>({.name = "health", .policy = runtime::on_crash::lose}, replaceable,
                                          std::shared_ptr<const health::peers>(of_health),
                                          health::outside_world{outside.read_host}, outside.reports);
  return made;
}

} // namespace godwit::daemon
