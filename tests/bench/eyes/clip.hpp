// The detector on pictures of people: a clip of a camera that stands still (vtest.avi of Debian's package opencv-doc),
// seen by a camera that moves over it in a known way, against boxes that were drawn by hand, and against OpenCV's MOG2
// on the clip itself.
//
// The motion (pan, turn, zoom, tilt, some shake) comes from a seed. It is one of a flat picture: there is no parallax.
// Errors: a sentence. Thread: one.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "tests/support/eyes/score.hpp"

namespace godwit::eyes::test {

struct clip_options {
  std::string clip = "/usr/share/doc/opencv-doc/examples/data/vtest.avi";
  std::string labels; // tests/data/eyes/vtest_labels.json
  std::uint64_t seed = 1;
  std::string folder; // of pictures of the labelled frames, with the labels in red; no name: none are drawn
};

struct pair_of_scores {
  score half;    // overlap 0.5
  score quarter; // 0.25
};

struct clip_figures {
  int frames = 0;
  int labelled = 0;
  int usable = 0;                 // pictures that the detector says something of
  pair_of_scores detector, naive; // against the labels, on the moved pictures
  pair_of_scores still;           // MOG2 against the labels, on the clip itself
  pair_of_scores rest;            // the detector against MOG2, in the other frames
  int rest_frames = 0;
  double fastest_px = 0; // the largest way of a corner from one picture to the next
  std::vector<double> corner_errors_px;
  std::vector<double> milliseconds; // processor time of the detector
};

[[nodiscard]] tl::expected<clip_figures, std::string> measure_clip(const clip_options& options);

} // namespace godwit::eyes::test
