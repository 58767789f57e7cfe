// About which tracks a classifier is asked, and how often: it may take a few milliseconds a picture on average.
//
// Next is who was never asked about, then who has the oldest answer. That something was not recognised counts against
// it only by day, where it is large enough, and while the net recognises anything at all in these pictures: from
// straight above, of heat or in haze it may know nothing. Thread: one at a time.
#pragma once

#include <functional>
#include <vector>

#include "programs/godwit-eyes/detection/classifier.hpp"
#include "programs/godwit-eyes/detection/tracker.hpp"

namespace godwit::eyes {

class class_questions {
public:
  static constexpr double ms_a_picture = 4;
  static constexpr double most_saved_ms = 40; // of pictures in which nobody was asked about
  static constexpr int least_seen = 3;
  static constexpr double least_length_px = 24;      // of the picture
  static constexpr double least_known_px = 28;       // from here on it would be recognised
  static constexpr double least_day_brightness = 60; // mean of the picture, of 255
  static constexpr double recognises_for_s = 10;     // after something was
  static constexpr double again_s = 0.5;

  using asker = std::function<class_answer(const frame_view& picture, const pixel_box& about)>;
  // NOW_MS: processor time of this thread.
  class_questions(asker who, std::function<double()> now_ms) : ask_(std::move(who)), now_ms_(std::move(now_ms)) {}

  // Each picture. REDUCTION: a pixel of the tracks by those of the picture.
  void step(std::vector<track>& tracks, const frame_view& picture, int reduction, double brightness, double dt_s);

private:
  void ask_about(track& who, const frame_view& picture, int reduction, double brightness);

  asker ask_;
  std::function<double()> now_ms_;
  double saved_ms_ = 0;
  double cost_ms_ = ms_a_picture;            // of the last answer
  double unrecognised_s_ = recognises_for_s; // since it has recognised something
};

} // namespace godwit::eyes
