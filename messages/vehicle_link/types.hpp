// All that is said to and by vehicle_link. Thread: plain values.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"
#include "messages/vehicle_link/command.hpp"
#include "messages/vehicle_link/connection.hpp"
#include "messages/vehicle_link/evidence.hpp"
#include "messages/vehicle_link/transfer.hpp"

namespace godwit::vehicle_link {

// What the link's thread and the timers say to vehicle_link: nothing that anybody else needs. Thread: plain values.

// Something has come in; it waits in `arrivals`, not in the mailbox.
struct wake {
  static constexpr auto fields = io::table("vehicle_link.wake");
};

} // namespace godwit::vehicle_link
