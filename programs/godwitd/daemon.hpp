// godwitd as it runs: the actors, what joins them to the world, and the order of their lives.
//
//   actor             joined to the world by        essential
//   vehicle_link      link_port: io/link            yes
//   mapobjects_store  map_port: the map's file      no
//   mission_client    http_service: io/http         no        (not there when the mission comes from a file)
//   ground_run        sighting_feed, line_printer   yes       (in the place of the executor)
//   control_desk      control::server               no
//
// Opened: journal, trace, actors, then the ports. Closed: the ports, then the actors, trace, journal. Thread: the main
// one; it waits until the run has ended, a signal has come, or the guardian gives up.
#pragma once

#include <functional>

#include "programs/godwitd/composition.hpp"
#include "programs/godwitd/settings.hpp"
#include "runtime/process.hpp"

namespace godwit::daemon {

// Called when all parts are made and none is started: a test adds actors of its own here.
using add_more = std::function<void(composition& made)>;

// Sentences go to stdout, what went wrong to stderr.
[[nodiscard]] runtime::exit_code run_daemon(daemon_settings wanted, const add_more& more = {});

} // namespace godwit::daemon
