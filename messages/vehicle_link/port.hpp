// What the link's thread and the timers say to vehicle_link: nothing that anybody else needs. Thread: plain values.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"

namespace godwit::vehicle_link {

// Something has come in; it waits in `arrivals`, not in the mailbox.
struct wake {
  static constexpr auto fields = io::table("vehicle_link.wake");
};

} // namespace godwit::vehicle_link
