// Parts of the picture in which a change proves nothing: those that stand still in it, and clutter.
#pragma once

#include <span>
#include <vector>

#include <opencv2/core.hpp>

#include "programs/godwit-eyes/detection/blobs.hpp"

namespace godwit::eyes {

// What stands still in the picture while the ground goes by: text and marks that a camera draws, landing gear, dirt.
//
// Whenever the ground has gone a few pixels, each pixel is compared with itself and with what the ground brings to it.
// One that stays although the ground brings something else gains, one that does not stay loses more. What a camera
// draws is exact to the pixel, also over seconds; a mover that the camera follows is not. Pixels are those of the
// reduced picture. Thread: one.
class still_parts {
public:
  // Every picture whose motion is known. BEFORE_TO_NOW: how the ground moved since the last one.
  void step(const cv::Mat& now, double dt_s, const cv::Matx33d& before_to_now);
  // The next picture can not be compared with those before. What is known to stand still is kept.
  void lose() { reference_.release(); }
  // Takes it out of a mask; nothing changes where nothing stands still.
  void clear(cv::Mat& mask) const;
  // Whether most of a box has stood still for a moment: text, or a mover that the camera follows.
  [[nodiscard]] bool may_stand(const cv::Rect2d& box) const;

private:
  void compare(const cv::Mat& now);

  cv::Mat reference_;
  cv::Matx33d reference_to_now_ = cv::Matx33d::eye();
  double reference_age_s_ = 0;
  cv::Mat evidence_; // a byte a pixel
  cv::Mat in_turn_;  // in so many comparisons it stayed, the last one among them
  cv::Mat still_;    // 255 where something stands still, and around it; empty: nothing does
  cv::Mat doubtful_; // likewise, for a moment at least
};

// Where in the picture the background can not be trusted: leaves, edges of what stands high, glints. Blobs there come
// and go, while those of a mover stay together from picture to picture.
//
// Counted is what begins: blobs that have no like one where the ground carried it from the last pictures, a second, in
// the cells of a grid that goes along with the ground. A picture with hardly any blobs is trusted as a whole. Pixels
// are those of the reduced picture. Thread: one.
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
