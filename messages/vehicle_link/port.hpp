// What the link's thread and the timers say to vehicle_link: nothing that anybody else needs. Thread: plain values.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"

namespace godwit::vehicle_link {

// Something has come in; it waits in `arrivals`, not in the mailbox.
struct wake {
  static constexpr auto fields = io::table("vehicle_link.wake");
};

// A deadline may have passed. One that was overtaken by a newer timer has an old number.
struct timer {
  std::uint64_t number = 0;
  static constexpr auto fields = io::table("vehicle_link.timer", io::field("number", &timer::number));
};

} // namespace godwit::vehicle_link
