// The way to one place, for who asks at each step.
//
// Near the place the flat formulas answer. Far away an exact answer is kept for a second's worth of steps: it is then
// at most some metres old, of kilometres. Thread: one at a time.
#pragma once

#include "programs/godwit-sim/vehicle/world/position.hpp"

namespace godwit::sim {

class way {
public:
  explicit way(const position& to) : to_(to) {}

  [[nodiscard]] const position& to() const { return to_; }
  // HERE moves by small steps between two calls.
  [[nodiscard]] course from(const position& here);

private:
  position to_;
  course exact_;
  int answers_left_ = 0; // that exact_ may still give
};

} // namespace godwit::sim
