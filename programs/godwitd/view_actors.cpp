#include "programs/godwitd/view_actors.hpp"

#include "actors/executor/actor.hpp"
#include "actors/failsafe/actor.hpp"
#include "actors/fleet_link/actor.hpp"
#include "actors/health/actor.hpp"
#include "actors/scan_controller/actor.hpp"
#include "actors/telemetry_stream/actor.hpp"
#include "programs/godwitd/flight_actors.hpp"

namespace godwit::daemon {

namespace {

telemetry_stream::own_handle add_stream(runtime::system& actors, const view_surroundings& outside,
                                        const base_actors& base, const flight_actors& flight) {
  const auto of_stream = std::make_shared<telemetry_stream::peers>();
  of_stream->map = base.store;
  of_stream->flight = flight.executor;
  of_stream->missions = flight.executor;
  of_stream->points = flight.scan;
  of_stream->pictured = outside.pictured_points;
  auto made = actors.add<telemetry_stream::actor>(
      {.name = name(child_name::telemetry_stream), .policy = runtime::on_crash::lose},
      policy_of(child_name::telemetry_stream), std::shared_ptr<const telemetry_stream::peers>(of_stream),
      outside.stream);
  base.of_vehicle->add(made);
  if (flight.of_executor) {
    flight.of_executor->watchers.emplace_back(made);
    flight.of_executor->viewers.emplace_back(made);
  }
  if (flight.of_scan)
    flight.of_scan->subscribers.emplace_back(made);
  return made;
}

fleet_link::own_handle add_fleet(runtime::system& actors, const view_surroundings& outside, const base_actors& base,
                                 const flight_actors& flight) {
  const auto of_fleet = std::make_shared<fleet_link::peers>();
  of_fleet->flight = flight.executor;
  of_fleet->failsafe = base.failsafe;
  of_fleet->guardian = actors.guardian();
  of_fleet->open_live = [hub = outside.stream] { return hub_reader::open(hub); };
  of_fleet->say = outside.fleet->say;
  auto made = actors.add<fleet_link::actor>({.name = name(child_name::fleet_link)}, policy_of(child_name::fleet_link),
                                            outside.fleet->how, std::shared_ptr<const fleet_link::peers>(of_fleet),
                                            outside.fleet->port, outside.fleet->process);
  if (flight.of_executor)
    flight.of_executor->watchers.emplace_back(made);
  if (flight.of_scan)
    flight.of_scan->subscribers.emplace_back(made);
  base.of_failsafe->ears.emplace_back(made);
  return made;
}

} // namespace

view_actors add_views(runtime::system& actors, const view_surroundings& outside, const base_actors& base,
                      const flight_actors& flight) {
  view_actors made;
  const auto of_health = std::make_shared<health::peers>();
  of_health->guardian = actors.guardian();
  of_health->flight = flight.executor;
  of_health->missions = flight.executor;
  of_health->traffic = flight.executor;
  of_health->failsafe = base.failsafe;
  of_health->vehicle = base.vehicle;
  of_health->ground = flight.ground;
  of_health->service = base.client;
  of_health->map = base.store;
  if (outside.stream) {
    made.stream = add_stream(actors, outside, base, flight);
    of_health->listeners.emplace_back(made.stream);
  }
  if (outside.fleet) {
    made.fleet = add_fleet(actors, outside, base, flight);
    of_health->listeners.emplace_back(made.fleet);
    of_health->fleet = made.fleet;
  }
  made.health = actors.add<health::actor>(
      {.name = name(child_name::health), .policy = runtime::on_crash::lose}, policy_of(child_name::health),
      std::shared_ptr<const health::peers>(of_health), health::outside_world{outside.read_host}, outside.reports);
  return made;
}

} // namespace godwit::daemon
