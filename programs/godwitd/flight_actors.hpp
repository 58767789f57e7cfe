// The actors of a flight, joined to each other: the one place for the daemon and for its simulation in virtual time.
//
//   autopilot ── wire ── vehicle_link ──> executor, failsafe, ground_port ── wire ── ground stations
//   missions service ── service_port ── mission_client ──> executor
//   file of the map ── map_port ── mapobjects_store
//   operators ── operator_bridge ──> executor
//   godwit-eyes ── eyes_port ── movement_detector ──> sightings, scan_controller
//   sighting_feed ── sightings ──> mapobjects_store, scan_controller ──> executor (what people are told)
//
// Whoever calls it owns what may block and what differs: ports, clock, journal, seed, facts about the host, the log. A
// run on the ground has the same base and somebody else in the executor's place.
//
//   auto base = add_base(actors, settings, outside);
//   auto flight = add_flight(actors, settings, outside, base);
//   actors.start();
//
// Thread: one owner, before the actors start. OUTSIDE outlives the actors, and its functions may be called by any
// thread.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "actors/executor/supervision/table.hpp"
#include "actors/mapobjects_store/map_port.hpp"
#include "actors/mission_client/service_port.hpp"
#include "actors/movement_detector/eyes_port.hpp"
#include "actors/operator_bridge/presence.hpp"
#include "actors/vehicle_link/listeners.hpp"
#include "io/link/wire.hpp"
#include "io/mavlink/signing/channel.hpp"
#include "messages/executor/handle.hpp"
#include "messages/failsafe/handle.hpp"
#include "messages/ground_port/handle.hpp"
#include "messages/mapobjects_store/handle.hpp"
#include "messages/mission_client/handle.hpp"
#include "messages/movement_detector/handle.hpp"
#include "messages/operator_bridge/handle.hpp"
#include "messages/scan_controller/handle.hpp"
#include "messages/vehicle_link/handle.hpp"
#include "programs/godwitd/camera_trial.hpp"
#include "programs/godwitd/host_facts.hpp"
#include "programs/godwitd/settings.hpp"
#include "programs/godwitd/sightings/messages.hpp"
#include "programs/godwitd/sightings/point_pictures.hpp"
#include "programs/godwitd/sightings/sighting_feed.hpp"
#include "runtime/journal/journal.hpp"
#include "runtime/journal/records.hpp"
#include "runtime/supervision/policy.hpp"
#include "runtime/system.hpp"

namespace godwit::executor {

struct peers;
struct phase_status;

} // namespace godwit::executor

namespace godwit::failsafe {
struct peers;
}

namespace godwit::mission_client {
struct peers;
}

namespace godwit::scan_controller {
struct peers;
}

namespace godwit::daemon {

using executor::supervision::child_name;

// What the actors meet of the world.
struct actor_surroundings {
  // -- ports; they outlive the incarnations of their actors
  std::shared_ptr<io::link::wire> vehicle;
  io::mavlink::signing_settings vehicle_signing;
  std::shared_ptr<mapobjects_store::map_port> map;
  std::shared_ptr<mission_client::service_port> service; // none: the mission comes from elsewhere
  std::shared_ptr<io::link::wire> ground;                // none: no ground station is spoken to
  io::mavlink::signing_settings ground_signing;
  std::shared_ptr<sighting_feed> sightings;               // none: nobody sees anything
  std::shared_ptr<movement_detector::eyes_port> eyes;     // with SETTINGS.camera, and with sightings; else none
  std::shared_ptr<daemon::point_pictures> point_pictures; // the same
  std::shared_ptr<camera_trial> camera;                   // none: the camera is not tried before the flight

  // Who hears that a session of an operator has ended.
  std::shared_ptr<operator_bridge::session_ends> session_ends = std::make_shared<operator_bridge::session_ends>();

  // Of this process, and of no other one: what is delivered has keys that are made with it.
  std::uint64_t seed = 0;
  const runtime::journal* journal = nullptr;
  host_facts* host = nullptr;
  executor::supervision::circumstances process; // before the actors start

  // A sentence for people. PART: of whom it is said.
  std::function<void(std::string_view part, const std::string& sentence, bool is_warning)> say;
  // How the flight stands: at each change, and as each incarnation of the executor begins.
  std::function<void(const executor::phase_status& now)> on_phase_status;
};

// What a flight and a run on the ground have in common.
struct base_actors {
  vehicle_link::own_handle vehicle;
  mapobjects_store::own_handle store;
  mission_client::own_handle client; // none without a service
  failsafe::own_handle failsafe;     // none in a run on the ground

  // Whom each actor speaks with; filled in before the actors start.
  std::shared_ptr<vehicle_link::listeners> of_vehicle;
  std::shared_ptr<mission_client::peers> of_client;
  std::shared_ptr<failsafe::peers> of_failsafe;
};

struct flight_actors {
  executor::own_handle executor;
  ground_port::own_handle ground; // none without a line for ground stations
  operator_bridge::own_handle bridge;
  scan_controller::own_handle scan;
  sightings::feeder_handle feeder;
  movement_detector::own_handle eyes; // none without a camera
  // Whom it speaks with; filled in before the actors start.
  std::shared_ptr<executor::peers> of_executor;
  std::shared_ptr<scan_controller::peers> of_scan;
};

// The table that holds until the executor has sent its own: from it on an essential actor that can not be kept up is
// met as its part of the flight demands. In a run on the ground nobody sends another. After the last add(), before the
// actors start.
void begin_supervision(runtime::system& actors, const executor::supervision::circumstances& process,
                       executor::supervision::part now);

// SETTINGS.flies: with a failsafe.
[[nodiscard]] base_actors add_base(runtime::system& actors, const daemon_settings& settings,
                                   const actor_surroundings& outside);

[[nodiscard]] flight_actors add_flight(runtime::system& actors, const daemon_settings& settings,
                                       const actor_surroundings& outside, const base_actors& base);

// Whether a vehicle flies, as the executor has left it in the journal: for what has to be decided before it runs.
// Thread: pure.

// EXECUTOR: what the journal has of it. What can not be read is no flight; the executor says why.
[[nodiscard]] bool is_in_flight(const runtime::recovered& executor);

} // namespace godwit::daemon
