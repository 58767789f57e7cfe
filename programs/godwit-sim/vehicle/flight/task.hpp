// What a vehicle is told to do; each task replaces the one before. Thread: values.
#pragma once

#include <variant>

#include "programs/godwit-sim/vehicle/world/position.hpp"

namespace godwit::sim {

struct task {
  struct rest { // motors off
    bool operator==(const rest&) const = default;
  };
  struct hold { // a rover stops; in the air it stays where it is, a wing on circles; on the ground it stays there
    bool operator==(const hold&) const = default;
  };
  struct go { // and hold there
    position to;
    double speed_mps = 0; // 0: the craft's own
    bool operator==(const go&) const = default;
  };
  struct climb {           // take off, or change altitude, above where it is; then hold
    double altitude_m = 0; // above mean sea level
    bool operator==(const climb&) const = default;
  };
  struct land { // where it is
    bool operator==(const land&) const = default;
  };
  struct come_back { // in the air: to the return altitude, home, land (a wing circles); a rover: home, and stop
    bool operator==(const come_back&) const = default;
  };
  struct follow_mission { // as mission() says; holds while it is idle and when it is complete
    bool operator==(const follow_mission&) const = default;
  };
  struct coast { // hands off in a manual mode: it comes to a stop; a wing in the air circles, as its pilot would
    bool operator==(const coast&) const = default;
  };
  using any = std::variant<rest, hold, go, climb, land, come_back, follow_mission, coast>;
};

} // namespace godwit::sim
