// What the service's thread and the timers say to mission_client: nothing that anybody else needs. Thread: plain
// values.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"

namespace godwit::mission_client {

// An answer of the service has come; it waits in the port, not in the mailbox.
struct wake {
  static constexpr auto fields = io::table("mission_client.wake");
};

} // namespace godwit::mission_client
