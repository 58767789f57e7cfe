// Runs the detector over a recording (or a camera, for some seconds), draws what it sees into pictures, and adds up.
//
// As in flight but for the pose, which recordings do not have: so there are no places on the ground, and a camera that
// turns fast is followed by the pictures alone. Errors: a sentence. Thread: one.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "io/video/camera_uri.hpp"
#include "programs/godwit-eyes/detection/detector.hpp"

namespace godwit::eyes {

struct look_settings {
  io::video::camera_uri from;
  std::string boxes;   // a file for what was found in each picture (look_files.hpp); no name: none
  std::string use;     // a file for whether each picture was of use; no name: none
  std::string model;   // a net (io/eyes/model_files.hpp); no name: none
  std::string folder;  // for the drawn pictures: is made, and must be empty; no name: nothing is drawn
  int every = 10;      // of the pictures one is drawn
  int most_drawn = 50; // then no more
  double begin_s = 0;  // of the recording; what comes before is passed over
  double seconds = 0;  // from there on; 0: to its end
};

struct track_summary {
  double first_s = 0;
  double last_s = 0;
  int pictures = 0;   // in which it was said
  double size_px = 0; // the longer side, at most
  double speed_px_s = 0;
  double confidence = 0;                           // at most
  object_class looks_like = object_class::unknown; // at the end
};

struct look_summary {
  static constexpr std::size_t max_values = 200'000; // of a list; further pictures count, and are in no list
  static constexpr std::size_t max_tracks = 10'000;  // that are listed

  std::uint64_t pictures = 0;
  int width = 0; // of the newest
  int height = 0;
  double begin_s = 0;
  double end_s = 0;
  std::array<std::uint64_t, unusable_count> reasons{};
  std::vector<double> residuals_px; // of the ground's motion, where it was found
  std::vector<double> corner_shifts_px;
  std::vector<double> milliseconds; // processor time
  std::map<std::uint32_t, track_summary> tracks;
  int drawn = 0;
  std::string ended_early; // why; empty: at the end, or as wished

  [[nodiscard]] std::uint64_t usable() const { return reasons[static_cast<std::size_t>(unusable::none)]; }
};

[[nodiscard]] tl::expected<look_summary, std::string> look_through(const look_settings& wanted);

// For people, with the last line's end.
[[nodiscard]] std::string table_of(const look_summary& seen);

} // namespace godwit::eyes
