// The durable decisions of mission_client: what each event makes of the state, and whom it is told.
//
// What is to be done next follows from the state alone (planner.hpp), so that after any crash it simply goes on.
// Nothing here knows the network. Thread: pure.
#pragma once

#include <cstdint>
#include <vector>

#include "actors/mission_client/events.hpp"
#include "actors/mission_client/state.hpp"

namespace godwit::mission_client {

// The table of deliveries is shortened each time that so many rows have left the outbox.
inline constexpr std::uint64_t resolved_rows_per_pruning = 100;

struct durable_core {
  using state = mission_client::state;
  using event = mission_client::event;
  using effect = mission_client::effect;

  [[nodiscard]] static std::vector<effect> apply(state& s, const event& happened, std::int64_t now_ns);
  // Assignments without a response: whoever flies may have forgotten them with its own crash.
  [[nodiscard]] static std::vector<effect> resume(const state& s, std::int64_t now_ns);
};

} // namespace godwit::mission_client
