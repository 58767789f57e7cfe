// Whether the sticks of a station (MANUAL_CONTROL) are held: a joystick that is switched on and left alone streams as
// well, and takes no vehicle.
//
//   x, y, r     held: more than 5 % of their way to an end from the middle
//   z           the throttle rests anywhere: more than 5 % of its range from where it was first
//   buttons     another one than before
//
// Where the throttle rests is where it was held last. Absent axes (INT16_MAX) are not looked at. A station that was
// silent for silent_ns begins anew; over the bound the one that was heard longest ago does. Pure. Times: ns, monotonic.
// Thread: one at a time. Source: MANUAL_CONTROL (69).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/mavlink/frame.hpp"
#include "io/mavlink/wire_format.hpp"

namespace godwit::ground_port::passing {

class stick_watch {
public:
  static constexpr std::int64_t silent_ns = 5'000'000'000;
  static constexpr std::size_t max_stations = 16;
  static constexpr int held_from = 50; // of 1000

  // True: a person holds them. PAYLOAD of MANUAL_CONTROL.
  [[nodiscard]] bool is_held(io::mavlink::sender by, io::mavlink::byte_view payload, std::int64_t now_ns);

private:
  struct rest {
    io::mavlink::sender by;
    int throttle = 0;
    unsigned buttons = 0;
    std::int64_t heard_ns = 0;
  };
  std::vector<rest> known_; // the one that was heard longest ago first
};

} // namespace godwit::ground_port::passing
