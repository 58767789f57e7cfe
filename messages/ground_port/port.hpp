// What the link's thread and the timers say to ground_port: nothing that anybody else needs. Thread: plain values.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"

namespace godwit::ground_port {

// Something has come in; it waits in the arrivals of the line, not in the mailbox.
struct wake {
  static constexpr auto fields = io::table("ground_port.wake");
};

} // namespace godwit::ground_port
