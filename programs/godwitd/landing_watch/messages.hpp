// What is said to the landing watch. Thread: plain values.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "runtime/seam.hpp"

namespace godwit::landing_watch {

struct tick {
  std::uint64_t incarnation = 0; // that goes on with it; those before have no time to keep any more
  GODWIT_FIELDS(tick, "landing_watch.tick", incarnation);
};

using own_handle = runtime::mailbox<runtime::tells<io::mavlink::heartbeat>, runtime::tells<tick>>;

} // namespace godwit::landing_watch
