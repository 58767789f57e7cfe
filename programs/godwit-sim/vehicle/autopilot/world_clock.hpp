// The world's time, which runs `speed` times as fast as the time outside.
//
// World time counts from the making of the vehicle and never goes back; the autopilot's own clock counts from its last
// start. Thread: values.
#pragma once

#include <cmath>
#include <cstdint>

#include "programs/godwit-sim/vehicle/autopilot/names.hpp"

namespace godwit::sim {

struct instant {
  std::int64_t real_ns = 0;
  std::int64_t world_ns = 0;
  double speed = 1; // of the world

  // The world's time after so long for people and programs, who live outside of it.
  [[nodiscard]] std::int64_t world_after(std::int64_t outside_ns) const {
    return world_ns + static_cast<std::int64_t>(static_cast<double>(outside_ns) * speed);
  }
};

class world_clock {
public:
  world_clock(double speed, std::int64_t now_ns) : speed_(speed), begin_ns_(now_ns) {}

  [[nodiscard]] instant at(std::int64_t real_ns) const { return {real_ns, world_ns(real_ns), speed_}; }

  [[nodiscard]] std::int64_t world_ns(std::int64_t real_ns) const {
    return static_cast<std::int64_t>(std::floor(static_cast<double>(real_ns - begin_ns_) * speed_));
  }

  // The time outside at which it is WORLD_NS, or a nanosecond later, never earlier.
  [[nodiscard]] std::int64_t real_ns(std::int64_t world) const {
    if (world == never_ns)
      return never_ns;
    auto result = begin_ns_ + static_cast<std::int64_t>(std::ceil(static_cast<double>(world) / speed_));
    while (world_ns(result) < world)
      ++result;
    return result;
  }

private:
  double speed_;
  std::int64_t begin_ns_;
};

} // namespace godwit::sim
