// What the link's thread and the timers say to ground_port: nothing that anybody else needs. Thread: plain values.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"

namespace godwit::ground_port {

// Something has come in; it waits in the arrivals of the line, not in the mailbox.
struct wake {
  static constexpr auto fields = io::table("ground_port.wake");
};

// A deadline may have passed. One that was overtaken by a newer timer has an old number.
struct timer {
  std::uint64_t number = 0;
  static constexpr auto fields = io::table("ground_port.timer", io::field("number", &timer::number));
};

} // namespace godwit::ground_port
