#include "programs/godwit-eyes/detection/appearance.hpp"

#include <algorithm>
#include <iterator>

namespace godwit::eyes {

namespace {

constexpr int recognised_to_be_sure = 2;
constexpr double extent_share = 0.5; // of a new extent in the smoothed one
constexpr double extent_lasts_s = 2;

cv::Rect2d between(const cv::Rect2d& from, const cv::Rect2d& to, double share) {
  return {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y),
          from.width + share * (to.width - from.width), from.height + share * (to.height - from.height)};
}

} // namespace

void appearance::add_recognised(io::eyes::object_class what, double score, const cv::Rect2d& box) {
  ++asked_;
  ++recognised_;
  since_s_ = 0;
  auto& its = classes_.at(static_cast<std::size_t>(what));
  const bool is_new = its.score == 0 || its.extent_s > extent_lasts_s;
  its.extent = is_new ? box : between(its.extent, box, extent_share);
  its.extent_s = 0;
  its.score += score;
}

void appearance::add_unrecognised(bool counts_against) {
  ++asked_;
  against_ += counts_against ? 1 : 0;
  since_s_ = 0;
}

void appearance::pass(double dt_s) {
  since_s_ += dt_s;
  for (auto& each : classes_)
    each.extent_s += dt_s;
}

std::size_t appearance::best_class() const {
  return static_cast<std::size_t>(
      std::distance(classes_.begin(), std::ranges::max_element(classes_, {}, &class_seen::score)));
}

io::eyes::object_class appearance::what() const {
  if (recognised_ == 0 || 2 * recognised_ < asked_)
    return io::eyes::object_class::unknown;
  return static_cast<io::eyes::object_class>(best_class());
}

bool appearance::is_recognised() const { return recognised_ >= recognised_to_be_sure && 2 * recognised_ > asked_; }

std::optional<cv::Rect2d> appearance::extent() const {
  const auto& its = classes_.at(best_class());
  if (what() == io::eyes::object_class::unknown || its.extent_s > extent_lasts_s)
    return std::nullopt;
  return its.extent;
}

} // namespace godwit::eyes
