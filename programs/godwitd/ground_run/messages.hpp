// What is said to the run on the ground by its own helpers and by who wants to know how far it is. Thread: plain
// values.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"
#include "messages/mission_client/handle.hpp"
#include "messages/vehicle_link/types.hpp"
#include "programs/godwitd/ground_run/core.hpp"
#include "runtime/seam.hpp"

namespace godwit::ground_run {

// The feed has sightings again, or has ended.
struct woken {
  static constexpr auto fields = io::table("ground_run.woken");
};

// Time to look at what was not answered.
struct tick {
  std::uint64_t incarnation = 0; // that goes on with it; those before have no time to keep any more
  GODWIT_FIELDS(tick, "ground_run.tick", incarnation);
};

struct retry_due {
  static constexpr auto fields = io::table("ground_run.retry_due");
};

struct get_run {
  static constexpr auto fields = io::table("ground_run.get_run");
};

struct run_status {
  std::string mission_id;
  ground_run::phase phase = ground_run::phase::loading;
  sighting_counts sightings;
  GODWIT_FIELDS(run_status, "ground_run.run_status", mission_id, phase, sightings);
};

// Who may say what to the run on the ground.
using feed_handle = runtime::mailbox<runtime::tells<woken>>;
using status_handle = runtime::mailbox<runtime::asks<get_run, run_status>>;

using own_handle = runtime::combine<
    mission_client::listener_handle,
    runtime::mailbox<runtime::tells<vehicle_link::connection_changed>, runtime::tells<woken>, runtime::tells<tick>,
                     runtime::tells<retry_due>, runtime::asks<get_run, run_status>>>;

} // namespace godwit::ground_run
