// What a classifier has answered about one track, and what follows from that. Thread: plain values.
#pragma once

#include <array>
#include <optional>

#include <opencv2/core.hpp>

#include "io/eyes/object_class.hpp"

namespace godwit::eyes {

class appearance {
public:
  // BOX: of what was recognised, about the place of the track. COUNTS_AGAINST: it would have been recognised.
  void add_recognised(io::eyes::object_class what, double score, const cv::Rect2d& box);
  void add_unrecognised(bool counts_against);
  void pass(double dt_s);

  [[nodiscard]] bool was_asked() const { return asked_ > 0; }
  [[nodiscard]] double since_s() const { return since_s_; } // the last answer
  // By most of its answers it is one of the classes; unknown: it is not.
  [[nodiscard]] io::eyes::object_class what() const;
  // Also when it was asked about again.
  [[nodiscard]] bool is_recognised() const;
  // It would have been recognised, and never was.
  [[nodiscard]] bool is_unlike() const { return against_ > 0 && recognised_ == 0; }
  [[nodiscard]] bool is_surely_unlike() const { return against_ > 1 && recognised_ == 0; }
  // About the place of the track, as it was recognised of late.
  [[nodiscard]] std::optional<cv::Rect2d> extent() const;

private:
  struct class_seen {
    double score = 0; // of all answers
    cv::Rect2d extent;
    double extent_s = 0; // its age
  };
  [[nodiscard]] std::size_t best_class() const;

  int asked_ = 0;
  int recognised_ = 0;
  int against_ = 0;
  double since_s_ = 0;
  std::array<class_seen, io::enum_table<io::eyes::object_class>.size()> classes_; // by their number
};

} // namespace godwit::eyes
