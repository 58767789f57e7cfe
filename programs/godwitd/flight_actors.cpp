#include "programs/godwitd/flight_actors.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include "actors/executor/actor.hpp"
#include "actors/executor/state.hpp"
#include "actors/failsafe/actor.hpp"
#include "actors/ground_port/actor.hpp"
#include "actors/mapobjects_store/actor.hpp"
#include "actors/mission_client/actor.hpp"
#include "actors/movement_detector/actor.hpp"
#include "actors/operator_bridge/actor.hpp"
#include "actors/scan_controller/actor.hpp"
#include "actors/vehicle_link/actor.hpp"
#include "io/sqlite/work_queue.hpp"
#include "programs/godwitd/landing_watch/actor.hpp"
#include "programs/godwitd/open_line.hpp"
#include "programs/godwitd/sightings/feeder.hpp"
#include "runtime/stored_state.hpp"

namespace godwit::daemon {

namespace {

constexpr auto executor_name = io::name_of(child_name::executor);
constexpr auto failsafe_name = io::name_of(child_name::failsafe);
constexpr auto scan_name = io::name_of(child_name::scan_controller);
constexpr auto feeder_name = io::name_of(child_name::sightings);
constexpr auto eyes_name = io::name_of(child_name::movement_detector);

executor::host_status read_host_status(const actor_surroundings& outside, const operator_bridge::presence& operators) {
  executor::host_status result;
  result.journal.is_sound = true; // it was checked as it was opened, and nothing runs with one that is not
  const auto journal = outside.journal->status();
  result.journal.is_writable = !journal.failing;
  result.journal.is_nearly_full = journal.fill >= io::sqlite::nearly_full;
  result.journal.free_bytes = outside.host->free_bytes();
  result.program.is_exchanged = outside.host->is_program_exchanged();
  result.operators.is_there = operators.is_there(outside.host->time().monotonic_ns());
  if (outside.camera)
    result.camera = outside.camera->look(outside.host->time().monotonic_ns());
  return result;
}

executor::outside_world world_of(const runtime::system& actors, const actor_surroundings& outside,
                                 const std::shared_ptr<operator_bridge::presence>& operators) {
  return {[&outside](const executor::announce& said) { outside.say(executor_name, said.sentence, said.is_warning); },
          [&outside, operators] { return read_host_status(outside, *operators); }, [&actors] { return actors.names(); },
          [&outside] { return outside.process; },
          [&outside](const executor::phase_status& status) {
            if (outside.sightings)
              outside.sightings->set_gate(status.in_flight);
            if (outside.camera)
              outside.camera->set_in_flight(status.in_flight);
            outside.on_phase_status(status);
            outside.say(executor_name,
                        "flight: " + std::string(io::name_of(status.now)) +
                            (status.reason.empty() ? "" : " (" + status.reason + ")"),
                        status.now == executor::phase::paused);
          }};
}

ground_port::settings settings_of_ground(const daemon_settings& settings) {
  ground_port::settings result;
  result.as.system = std::max<std::uint8_t>(settings.vehicle_system, 1);
  if (settings.speaks_as_autopilot)
    result.as.component = io::mavlink::number(io::mavlink::mav_component::autopilot1);
  result.passes = settings.ground_passes;
  result.also_passes = settings.ground_also_passes;
  result.max_items = settings.ground_max_items;
  result.allowed_commands = settings.allowed_commands;
  result.stations_are = settings.ground_key_file.empty() ? settings.unsigned_stations : operators::role::operator_;
  if (settings.ground) {
    const bool is_signed = !settings.ground_key_file.empty();
    result.heartbeats_to_begin = heartbeats_to_begin(*settings.ground, is_signed);
    result.open_line = open_line_warning(*settings.ground, is_signed, "--ground-signing-key");
  }
  return result;
}

// What is seen goes into the map, and what of it is worth a look to people.
void add_scan(runtime::system& actors, const daemon_settings& settings, const actor_surroundings& outside,
              const base_actors& base, flight_actors& made) {
  const auto of_scan = std::make_shared<scan_controller::peers>();
  made.scan = actors.add<scan_controller::actor>({.name = name(child_name::scan_controller)},
                                                 policy_of(child_name::scan_controller), settings.scan,
                                                 std::shared_ptr<const scan_controller::peers>(of_scan), outside.seed);
  made.of_scan = of_scan;
  of_scan->map = base.store;
  of_scan->subscribers.emplace_back(made.executor);
  of_scan->say = [&outside](const std::string& sentence, bool is_warning) {
    outside.say(scan_name, sentence, is_warning);
  };
  base.of_vehicle->add(made.scan);
  made.feeder = actors.add<sightings::feeder>(
      {.name = name(child_name::sightings)}, policy_of(child_name::sightings),
      sightings::feeder_settings{settings.mission_id, outside.service == nullptr}, sightings::store_handle(base.store),
      scan_controller::candidate_handle(made.scan),
      outside.service ? std::optional(mission_client::picture_handle(base.client)) : std::nullopt, outside.sightings,
      outside.point_pictures, [&outside](const std::string& sentence) { outside.say(feeder_name, sentence, true); });
}

void add_eyes(runtime::system& actors, const daemon_settings& settings, const actor_surroundings& outside,
              const base_actors& base, flight_actors& made) {
  const auto of_eyes = std::make_shared<movement_detector::peers>();
  made.eyes = actors.add<movement_detector::actor>(
      {.name = name(child_name::movement_detector), .policy = runtime::on_crash::lose},
      policy_of(child_name::movement_detector), *settings.camera,
      std::shared_ptr<const movement_detector::peers>(of_eyes), outside.eyes, outside.seed);
  of_eyes->sightings = made.feeder;
  of_eyes->scan = made.scan;
  of_eyes->say = [&outside](const std::string& sentence, bool is_warning) {
    outside.say(eyes_name, sentence, is_warning);
  };
  base.of_vehicle->add(made.eyes);
}

} // namespace

void begin_supervision(runtime::system& actors, const executor::supervision::circumstances& process,
                       executor::supervision::part now) {
  namespace supervision = executor::supervision;
  actors.set_floor(supervision::floor_children());
  actors.let_end_fast(process.may_end_fast);
  actors.begin_with(supervision::table_of(now, process, actors.names(), false)); // the executor knows what is flown
}

base_actors add_base(runtime::system& actors, const daemon_settings& settings, const actor_surroundings& outside) {
  base_actors made;
  made.of_vehicle = std::make_shared<vehicle_link::listeners>();
  made.of_client = std::make_shared<mission_client::peers>();
  made.of_failsafe = std::make_shared<failsafe::peers>();
  auto link = settings.link;
  link.watch.system = settings.vehicle_system;
  link.relays = settings.flies && settings.ground_passes && outside.ground;
  if (settings.flies && outside.ground)
    link.streams = vehicle_link::streams_for_stations();
  const bool is_signed = !settings.signing_key_file.empty();
  link.watch.heartbeats_to_begin = heartbeats_to_begin(settings.vehicle, is_signed);
  link.open_line = open_line_warning(settings.vehicle, is_signed, "--signing-key");
  if (settings.flies)
    link.deciders = {name(child_name::executor), name(child_name::failsafe)};
  const auto& ping = settings.process.actors.ping;
  link.alive_lasts_ms = std::max(ping.warn, 2 * ping.period).count();
  made.vehicle = actors.add<vehicle_link::actor>(
      {.name = name(child_name::vehicle_link)}, policy_of(child_name::vehicle_link), link, outside.vehicle_signing,
      outside.vehicle, std::shared_ptr<const vehicle_link::listeners>(made.of_vehicle));
  actors.tell_who_lives(made.vehicle, link.deciders);
  if (settings.flies)
    made.failsafe = actors.add<failsafe::actor>({.name = name(child_name::failsafe)}, policy_of(child_name::failsafe),
                                                settings.failsafe, made.vehicle,
                                                std::shared_ptr<const failsafe::peers>(made.of_failsafe));
  made.store = actors.add<mapobjects_store::actor>({.name = name(child_name::mapobjects_store)},
                                                   policy_of(child_name::mapobjects_store), outside.map);
  if (outside.service)
    made.client = actors.add<mission_client::actor>(
        {.name = name(child_name::mission_client)}, policy_of(child_name::mission_client), settings.client,
        outside.service, std::shared_ptr<const mission_client::peers>(made.of_client), outside.seed);
  made.of_client->map = made.store;
  return made;
}

flight_actors add_flight(runtime::system& actors, const daemon_settings& settings, const actor_surroundings& outside,
                         const base_actors& base) {
  flight_actors made;
  const auto of_executor = std::make_shared<executor::peers>();
  made.of_executor = of_executor;
  const auto operators = std::make_shared<operator_bridge::presence>();
  std::vector<operator_bridge::control_listener> of_control;
  const auto of_ground = std::make_shared<ground_port::peers>();
  made.executor = actors.add<executor::actor>({.name = name(child_name::executor)}, policy_of(child_name::executor),
                                              settings.flight, std::shared_ptr<const executor::peers>(of_executor),
                                              world_of(actors, outside, operators));
  if (outside.ground) {
    made.ground = actors.add<ground_port::actor>(
        {.name = name(child_name::ground_port)}, policy_of(child_name::ground_port), settings_of_ground(settings),
        outside.ground_signing, outside.ground, std::shared_ptr<const ground_port::peers>(of_ground));
    of_executor->port = made.ground;
    of_control.emplace_back(made.ground);
    of_ground->executor = made.executor;
    of_ground->vehicle = base.vehicle;
    of_ground->failsafe = base.failsafe;
    of_ground->operator_ears.emplace_back(base.failsafe);
    base.of_failsafe->people.emplace_back(made.ground);
    base.of_vehicle->add(made.ground);
  }
  made.bridge = actors.add<operator_bridge::actor>({.name = name(child_name::operator_bridge)},
                                                   policy_of(child_name::operator_bridge), settings.sessions,
                                                   made.executor, operators, of_control, outside.session_ends,
                                                   std::vector<operator_bridge::holder_ear>{base.failsafe});
  of_ground->bridge = made.bridge;
  of_executor->vehicle = base.vehicle;
  of_executor->guardian = actors.guardian();
  actors.set_supervisor(made.executor);
  of_executor->failsafe = base.failsafe;
  if (outside.service)
    of_executor->client = base.client;
  add_scan(actors, settings, outside, base, made);
  of_executor->scan = made.scan;
  if (settings.camera && outside.eyes) {
    add_eyes(actors, settings, outside, base, made);
    of_executor->eyes = made.eyes;
  }
  base.of_failsafe->ears.emplace_back(made.executor);
  base.of_failsafe->log = [&outside](const failsafe::warning& said) {
    outside.say(failsafe_name, said.text, said.severity <= io::mavlink::mav_severity::warning);
  };
  base.of_client->listener = made.executor;
  base.of_vehicle->add(base.failsafe);
  base.of_vehicle->add(made.executor);
  base.of_vehicle->add(actors.add<landing_watch::actor>(
      {.name = name(child_name::landing_watch)}, policy_of(child_name::landing_watch), actors.guardian(),
      name(child_name::executor), landing_watch::process_end([&actors](const std::string& why) {
        actors.request_exit({runtime::exit_cause::essential_given_up, why});
      })));
  return made;
}

bool is_in_flight(const runtime::recovered& executor) {
  using executor::durable_core;
  using executor::phase_status;
  try {
    bool result =
        executor.snapshot && runtime::read_state<durable_core>("executor", *executor.snapshot).status.in_flight;
    for (const auto& each : executor.events)
      if (each.type == phase_status::fields.type_name)
        result =
            std::get<phase_status>(runtime::read_alternative<durable_core::event>("executor", each.type, each.body))
                .in_flight;
    return result;
  } catch (const std::exception&) {
    return false;
  }
}

} // namespace godwit::daemon
