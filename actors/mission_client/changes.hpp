// What the answer to a waypoint or a tail means. Somebody waits for it, so that it ends within two seconds one way or
// the other; a change whose fate is not known is looked up (fetching.hpp). Thread: pure.
#pragma once

#include "actors/mission_client/events.hpp"
#include "actors/mission_client/outbox/outbox.hpp"
#include "actors/mission_client/response_queue.hpp"

namespace godwit::mission_client {

// change_done, change_failed, mission_gone, or rows_failed when it is tried again.
[[nodiscard]] event outcome_of_change(const outbox_row& row, const service_answer& answer, std::int64_t wall_ns);

} // namespace godwit::mission_client
