// The same as world/position.hpp for places that lie near each other: ten to fifty times as fast.
//
// The ellipsoid is taken for flat between the two places, with its radii of curvature in the middle of them. For a
// kilometre the error is well below a millimetre; near the poles, where that does not hold, is_level() says no and the
// exact functions are used. Thread: pure. Source: mid-latitude formulas of navigation, with the convergence of the
// meridians.
#pragma once

#include "programs/godwit-sim/vehicle/world/position.hpp"

namespace godwit::sim {

// Whether FROM and TO are so near, and so far from a pole, that the functions below serve.
[[nodiscard]] bool is_nearby(const position& from, const position& to);
// is_nearby(FROM, TO) holds.
[[nodiscard]] course course_nearby(const position& from, const position& to);
// By one step of at most max_step_m, anywhere on Earth.
[[nodiscard]] position stepped(const position& from, double north_m, double east_m);

constexpr double max_step_m = 10;

// The way to one place, for who asks at each step.
//
// Near the place the flat formulas answer. Far away an exact answer is kept for a second's worth of steps: it is then
// at most some metres old, of kilometres. Thread: one at a time.
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
