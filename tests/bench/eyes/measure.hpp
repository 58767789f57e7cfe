// What is measured of the detector on the scenes of the generator. Times are processor time of this thread. Thread:
// one.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/support/eyes/score.hpp"
#include "tests/support/eyes/suite.hpp"

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
  std::string folder; // of pictures in which it is drawn what was seen, one of fifteen; no name: none are drawn
};

// One flight, added to SUM.
void measure(std::uint64_t seed, sim::camera::tier which, const measure_options& options, measured& sum);

// Of the middle of a picture that looks 45 degrees off the nadir from 100 m.
struct place_figures {
  double at_one_degree_m = 0; // the largest distance for an attitude that is wrong by one degree in any direction
  double geometry_m = 0;      // of these, what the geometry alone makes: height * (tan(46 deg) - tan(45 deg))
  double median_m = 0;        // for attitudes with a standard deviation of one degree in each axis
  double share_inside = 0;    // of these: within two deviations of what the place says of itself (95 in 100)
};
[[nodiscard]] place_figures measure_places(int count);

// SHARE 0..1 of the sorted values; 0 where there are none.
[[nodiscard]] double quantile(std::vector<double> values, double share);

} // namespace godwit::eyes::test
