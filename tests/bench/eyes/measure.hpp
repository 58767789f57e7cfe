// What is measured of the detector on the scenes of the generator. Times are processor time of this thread. Thread:
// one.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "programs/godwit-sim/camera/suite.hpp"
#include "tests/support/eyes/score.hpp"

namespace godwit::eyes::test {

struct measured {
  score at_half, at_quarter;        // of the detector; overlap 0.5 and 0.25
  score naive_half, naive_quarter;  // as one writes it first
  score tuned_half, tuned_quarter;  // with tuned constants
  std::vector<double> milliseconds; // of the detector, each picture
  std::vector<double> naive_milliseconds;
  std::vector<double> corner_errors_px; // of the homography, the four corners of each picture
  std::map<std::string, int> reasons;
  int tracks = 0; // confirmed, with different numbers
  int frames = 0;
};

struct measure_options {
  sim::camera::suite_options scene;
  int frames = 90;      // of each seed; the first 30 are not scored
  bool has_pose = true; // with a constant error of 0.8 degrees
  bool has_naive = true;
};

// One flight, added to SUM.
void measure(std::uint64_t seed, sim::camera::tier which, const measure_options& options, measured& sum);

// SHARE 0..1 of the sorted values; 0 where there are none.
[[nodiscard]] double quantile(std::vector<double> values, double share);

} // namespace godwit::eyes::test
