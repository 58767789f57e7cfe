// What becomes of a change of the mission in the durable state (state.hpp). Thread: plain values.
#pragma once

#include <string>

#include "actors/executor/state.hpp"

namespace godwit::executor {

// What mission_client is to do with it.
[[nodiscard]] durable_core::effect order_for_service(const std::string& mission_id, const mission_change& what);

// The mission has it, or never will. With the mission back nothing is set aside any more.
void resolve_change(state& s, bool is_done);

// Something else was commanded, or somebody else has the vehicle. What is not here yet is not flown any more; what is
// comes to the vehicle, and is not begun.
void stop_change(state& s);

// Or the same. A revision that we have numbered ourselves makes none of the service's old.
[[nodiscard]] bool is_older_than_mission(const state& s, const mission::document& other);

// Of one that is flown.
void answer_flown_change(state& s, const change_answered& happened);

} // namespace godwit::executor
