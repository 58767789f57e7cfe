// Where in the picture the background can not be trusted: leaves, edges of what stands high, glints. Blobs there come
// and go, while those of a mover stay together from picture to picture.
//
// Counted is what begins: blobs that have no like one where the ground carried it from the last pictures, a second, in
// the cells of a grid that goes along with the ground. A picture with hardly any blobs is trusted as a whole. Pixels
// are those of the reduced picture. Thread: one.
#pragma once

#include <span>
#include <vector>

#include <opencv2/core.hpp>

#include "programs/godwit-eyes/detection/blobs.hpp"

namespace godwit::eyes {

class clutter_map {
public:
  // Every picture, also one without blobs. BLOBS: of the background. GROUND: how it moved since the last one.
  void step(std::span<const blob> blobs, double dt_s, const cv::Matx33d& ground, const cv::Size& picture);
  void forget();
  // Blobs a second that begin around a place, within an eighth of the picture's width; 0 where there are hardly any.
  [[nodiscard]] double births_around(const cv::Point2d& place) const;
  [[nodiscard]] bool is_calm_at(const cv::Point2d& place) const;
  [[nodiscard]] bool is_calm() const; // as a whole

private:
  struct known_blob {
    cv::Rect2d box;
    int missed = 0; // pictures
  };
  [[nodiscard]] bool recognize(const cv::Rect2d& box);
  [[nodiscard]] cv::Point cell_of(const cv::Point2d& place) const;

  static constexpr double first_count = 8; // what was not seen yet is not trusted

  cv::Mat births_; // a second, in each cell
  std::vector<known_blob> known_;
  double count_ = first_count; // blobs a picture, smoothed
  cv::Size picture_;
};

} // namespace godwit::eyes
