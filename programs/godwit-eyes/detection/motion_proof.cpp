#include "programs/godwit-eyes/detection/motion_proof.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "programs/godwit-eyes/detection/own_motion.hpp"

namespace godwit::eyes {

namespace {

constexpr int least_part_px = 7; // of the part that is compared: fewer pixels look like many others
constexpr int most_part_px = 31;
constexpr double still_slack_px = 1.5; // around where something still may lie
constexpr double moved_slack_px = 2.5; // around where it was followed to
constexpr double least_likeness = 0.5; // correlation
constexpr double least_lead = 0.15;    // over the best place of something still

double distance_to_segment(const cv::Point2d& point, const cv::Point2d& from, const cv::Point2d& to) {
  const cv::Point2d along = to - from;
  const double length_squared = along.dot(along);
  const double share = length_squared < 1e-9 ? 0 : std::clamp((point - from).dot(along) / length_squared, 0.0, 1.0);
  return cv::norm(point - from - share * along);
}

// Odd, so that there is a pixel in the middle.
int side_of(double length) { return std::clamp(static_cast<int>(length), least_part_px, most_part_px) | 1; }

// The part of an earlier picture around a place, as the ground there lies in the newest one.
cv::Mat part_as_now(const cv::Mat& then, const cv::Matx33d& then_to_now, const cv::Point2d& middle,
                    const cv::Size& size) {
  const cv::Matx33d part_to_now(1, 0, middle.x - size.width / 2, 0, 1, middle.y - size.height / 2, 0, 0, 1);
  cv::Mat part;
  cv::warpPerspective(then, part, then_to_now.inv() * part_to_now, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                      cv::BORDER_REPLICATE);
  return part;
}

struct likeness {
  double where_still = 0;
  double where_followed = 0;
};

} // namespace

void motion_proof::add(const cv::Mat& picture, double dt_s, const cv::Matx33d& before_to_now) {
  add_newest(pictures_, picture, dt_s, before_to_now);
  if (pictures_.size() > most_pictures)
    pictures_.pop_front();
}

bool motion_proof::has_moved(const track& who, const still_reach& still) const {
  const auto count = static_cast<int>(pictures_.size());
  const auto first =
      std::ranges::find_if(who.places, [&](const track::place& each) { return who.age - each.age < count; });
  if (first == who.places.end() || who.missed > 0)
    return false;
  const past_picture& then = pictures_[static_cast<std::size_t>(count - 1 - (who.age - first->age))];
  const cv::Mat& now = pictures_.back().picture;
  const cv::Point2d is = middle_of(who.places.back().box);
  const cv::Point2d stood = moved(then.to_now, middle_of(first->box));
  const cv::Point2d farthest = stood + then.age_s * still.fastest_px_s;
  const double still_px = still.sway_px + still_slack_px;
  if (distance_to_segment(is, stood, farthest) < still_px + 1)
    return false;

  const cv::Size size(side_of(first->box.width), side_of(first->box.height));
  const cv::Point2d reach(still_px + size.width / 2 + 1, still_px + size.height / 2 + 1);
  const cv::Rect around = (cv::Rect(cv::Point(stood - reach), cv::Point(stood + reach)) |
                           cv::Rect(cv::Point(farthest - reach), cv::Point(farthest + reach)) |
                           cv::Rect(cv::Point(is - reach), cv::Point(is + reach))) &
                          cv::Rect(cv::Point(), now.size());
  if (around.width <= size.width || around.height <= size.height)
    return false;
  cv::Mat fits;
  cv::matchTemplate(now(around), part_as_now(then.picture, then.to_now, stood, size), fits, cv::TM_CCOEFF_NORMED);
  likeness best;
  for (int y = 0; y < fits.rows; ++y)
    for (int x = 0; x < fits.cols; ++x) {
      const double fit = fits.at<float>(y, x);
      const cv::Point2d at(around.x + x + size.width / 2, around.y + y + size.height / 2);
      if (distance_to_segment(at, stood, farthest) <= still_px)
        best.where_still = std::max(best.where_still, fit);
      else if (cv::norm(at - is) <= moved_slack_px)
        best.where_followed = std::max(best.where_followed, fit);
    }
  return best.where_followed >= least_likeness && best.where_followed <= 1.01 && // no texture: it is not a number
         best.where_followed >= best.where_still + least_lead;
}

} // namespace godwit::eyes
