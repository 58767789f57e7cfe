// The detector on recordings with labels: a folder that holds for each clip NAME.json
// (tests/support/eyes/clip_score.hpp, docs/godwit-eyes.md) and NAME with any other ending, a recording that
// `godwit-eyes look` reads.
//
// How the ground moved is found by corners and a homography of its own, not by the detector's, and kept beside the
// labels (NAME.ground) for the next time. No pose. Errors: a sentence. Thread: one.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "tests/support/eyes/clip_score.hpp"

namespace godwit::eyes::test {

struct recording_figures {
  std::string name;
  clip_score score;
  std::vector<double> milliseconds;   // processor time of the detector, each picture
  std::map<std::string, int> reasons; // of pictures of no use
};

// DRAW: a folder for drawn pictures, one of ten; no name: none are drawn. MODEL: no name: without.
[[nodiscard]] tl::expected<std::vector<recording_figures>, std::string>
measure_recordings(const std::string& folder, const std::string& draw, const std::string& model);

void print_recordings(const std::vector<recording_figures>& all);

} // namespace godwit::eyes::test
