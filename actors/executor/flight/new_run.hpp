// A mission that is over, flown again from its first item: as a mission of its own with a new id, so that the reports
// of both runs are kept apart. It is checked and uploaded; another start begins it. For missions that people brought by
// a file, the operators' page or a ground station: a missions service decides itself what is flown next. Pure.
// Thread: one at a time.
#pragma once

#include <string>

#include "actors/executor/flight/flight_context.hpp"

namespace godwit::executor {

// Empty: the mission that is over can be flown again.
[[nodiscard]] std::string why_no_new_run(const flight_context& flight);
// The one that an operator has asked for (command_queue::new_run). False: there is none.
[[nodiscard]] bool begin_new_run(flight_context& flight, effects& out, instant now);

} // namespace godwit::executor
