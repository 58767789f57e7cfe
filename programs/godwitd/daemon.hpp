// godwitd as it runs: the actors, what joins them to the world, and the order of their lives.
//
//   actor             joined to the world by        essential
//   vehicle_link      link_port: io/link            yes
//   mapobjects_store  map_port: the map's file      no
//   mission_client    http_service: io/http         no        (not there when the mission comes from a file)
//   ground_run        sighting_feed, program_log    yes       (in the place of the executor)
//   control_requests      control::server               no
//
// Opened: log, journal, trace, actors, then the ports; then the service manager hears that godwitd is ready. Closed:
// the ports, then the actors, trace, journal, log. Thread: the main one; it waits until the run has ended, a signal has
// come, or the guardian gives up.
#pragma once

#include <functional>

#include "programs/godwitd/composition.hpp"
#include "programs/godwitd/settings.hpp"
#include "runtime/process.hpp"

namespace godwit::daemon {

// Called when all parts are made and none is started: a test adds actors of its own here.
using add_more = std::function<void(composition& made)>;

// What happens goes to the log, what went wrong to stderr too.
[[nodiscard]] runtime::exit_code run_daemon(daemon_settings wanted, const add_more& more = {});

} // namespace godwit::daemon
