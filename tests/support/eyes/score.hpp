// How well boxes agree with the truth: greedy one-to-one match by falling overlap (intersection by union), added up
// over all pictures (micro average).
//
// Not counted, neither as found nor as missed nor as false: true movers that are cut by the border or have their middle
// within `border_px` of it, are hidden by more than half, have a longer side below `min_size_px`, or move by less than
// `min_speed_px` a frame against the ground; boxes whose middle is within `border_px` of the border; boxes that lie
// over a true mover that is not counted. Thread: plain values.
#pragma once

#include <span>
#include <vector>

#include "programs/godwit-eyes/detection/detector.hpp"
#include "programs/godwit-sim/camera/generator.hpp"

namespace godwit::eyes::test {

struct score_rules {
  double overlap = 0.5;
  int width = 1280;
  int height = 720;
  // In pixels of a picture 1280 wide; scaled for others.
  double border_px = 16;
  double min_size_px = 8;
  double min_speed_px = 0.3;
};

struct score {
  int found = 0;
  int missed = 0;
  int wrong = 0;

  [[nodiscard]] double precision() const { return found == 0 ? 0 : static_cast<double>(found) / (found + wrong); }
  [[nodiscard]] double recall() const { return found == 0 ? 0 : static_cast<double>(found) / (found + missed); }
  [[nodiscard]] double f1() const { return found == 0 ? 0 : 2.0 * found / (2.0 * found + missed + wrong); }
  score& operator+=(const score& other);
};

// Intersection by union; 0 where they do not touch.
[[nodiscard]] double overlap_of(const pixel_box& a, const pixel_box& b);

[[nodiscard]] score score_of(const sim::camera::truth& real, std::span<const pixel_box> seen, const score_rules& rules);

} // namespace godwit::eyes::test
