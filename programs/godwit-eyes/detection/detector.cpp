#include "programs/godwit-eyes/detection/detector.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>

#include <malloc.h>
#include <opencv2/imgproc.hpp>

#include "programs/godwit-eyes/detection/background_model.hpp"
#include "programs/godwit-eyes/detection/blobs.hpp"
#include "programs/godwit-eyes/detection/change.hpp"
#include "programs/godwit-eyes/detection/class_questions.hpp"
#include "programs/godwit-eyes/detection/classifier.hpp"
#include "programs/godwit-eyes/detection/clutter.hpp"
#include "programs/godwit-eyes/detection/motion_proof.hpp"
#include "programs/godwit-eyes/detection/own_motion.hpp"
#include "programs/godwit-eyes/detection/parallax.hpp"
#include "programs/godwit-eyes/detection/picture_check.hpp"
#include "programs/godwit-eyes/detection/thread_time.hpp"
#include "programs/godwit-eyes/detection/tracker.hpp"
#include "programs/godwit-eyes/ground/sight.hpp"
#include "runtime/assert.hpp"

namespace godwit::eyes {

namespace {

constexpr double even_brightness = 115;
constexpr double least_change = 8; // grey levels
constexpr double free_gain = 1.5;  // up to which a brighter picture has no more noise to speak of
constexpr double longest_gap_s = 0.5;
constexpr int most_coasting = 3; // a track that was not seen for longer is not said

// From reduced pixels to those of the picture: the middle of a block of REDUCTION pixels.
cv::Matx33d scaled_up(const cv::Matx33d& way, int reduction) {
  const double s = reduction;
  const double o = (s - 1) / 2;
  const cv::Matx33d up(s, 0, o, 0, s, o, 0, 0, 1);
  return up * way * up.inv();
}

// The same the other way round, from pixels of the picture.
cv::Matx33d scaled_down(const Eigen::Matrix3d& way, int reduction) {
  cv::Matx33d full;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      full(row, column) = way(row, column);
  const double s = reduction;
  const double o = (s - 1) / 2;
  const cv::Matx33d up(s, 0, o, 0, s, o, 0, 0, 1);
  return up.inv() * full * up;
}

// In most of the pictures in which it was seen it went as something high would.
bool is_parallax(const track& who) { return 2 * who.along_parallax > who.seen; }

constexpr std::size_t most_sights = 128;
constexpr double sway_m = 0.5;          // of the top of a tree, from where it was
constexpr double velocity_over_s = 0.7; // of the camera: long enough for positions that come five times a second

} // namespace

struct detector::parts {
  parts(const detector_settings& given, const std::shared_ptr<classifier>& asked)
      : settings(given), tracks({given.frames_to_confirm, static_cast<std::size_t>(given.max_tracks)}) {
    if (asked)
      questions.emplace(
          [asked](const frame_view& picture, const pixel_box& about) { return asked->ask(picture, about); }, thread_ms);
  }

  void begin_anew();
  [[nodiscard]] verdict look(const frame_view& frame, const std::optional<camera_pose>& pose);
  [[nodiscard]] unusable find(const frame_view& frame, const cv::Mat& now, verdict& said);
  [[nodiscard]] unusable take_pose(const std::optional<camera_pose>& pose, std::int64_t at_ns);
  [[nodiscard]] Eigen::Vector3d camera_velocity() const;
  void mark_parallax();
  [[nodiscard]] std::optional<still_reach> reach_at(const cv::Point2d& place) const;
  [[nodiscard]] std::optional<unsaid_reason> why_unsaid(const track& who, const pixel_box& box) const;
  void say(verdict& said) const;

  detector_settings settings;
  own_motion motion;
  motion_proof proof;
  recent_change change;
  still_parts stands;
  background_model background;
  clutter_map clutter;
  tracker tracks;
  std::optional<class_questions> questions;
  cv::Mat last;
  int width = 0;
  int height = 0;
  int reduction = 1;
  std::int64_t last_ns = 0;
  std::int64_t found_ns = 0; // of the picture with which the next one is compared
  std::optional<sight> found_from;
  int pictures = 0;         // since it began anew
  std::deque<sight> sights; // of the last pictures, the newest at the back; empty: the pose is not known
};

void detector::parts::begin_anew() {
  motion.forget();
  stands.lose();
  change.forget();
  background.forget();
  clutter.forget();
  proof.forget();
  tracks.forget();
  sights.clear();
  found_from.reset();
  last.release();
  pictures = 0;
}

verdict detector::parts::look(const frame_view& frame, const std::optional<camera_pose>& pose) {
  verdict said;
  said.why = check_frame(frame);
  if (said.why != unusable::none)
    return said;
  const double dt_s = static_cast<double>(frame.captured_ns - last_ns) * 1e-9;
  if (frame.width != width || frame.height != height || dt_s <= 0 || dt_s > longest_gap_s) {
    begin_anew();
    width = frame.width;
    height = frame.height;
    reduction = reduction_for(width, settings.working_width_px);
  }
  last_ns = frame.captured_ns;
  const cv::Mat now = reduced(frame, reduction);
  const auto state = judge(now);
  said.figures.brightness = state.brightness;
  said.why = state.why;
  if (said.why == unusable::none && !last.empty() && cv::norm(now, last, cv::NORM_INF) == 0)
    said.why = unusable::repeated;
  if (said.why == unusable::repeated)
    return said; // the next one is compared with this
  last = now;
  if (said.why != unusable::none) {
    begin_anew();
    return said;
  }
  const unusable flaw = take_pose(pose, frame.captured_ns);
  said.why = find(frame, now, said); // also where the pose is wrong: the next picture needs this one
  if (flaw != unusable::none)
    said.why = flaw;
  if (said.why == unusable::none)
    say(said);
  return said;
}

// Keeps the sight where the pose is right; the reason why it says nothing where it is not.
unusable detector::parts::take_pose(const std::optional<camera_pose>& pose, std::int64_t at_ns) {
  if (!pose || !settings.camera) {
    sights.clear();
    return unusable::none;
  }
  if (const auto flaw = flaw_of(*pose, at_ns); flaw != pose_flaw::none) {
    sights.clear();
    return flaw == pose_flaw::too_old ? unusable::attitude_old : unusable::bad_pose;
  }
  sights.emplace_back(*settings.camera, *pose, at_ns, width);
  while (sights.size() > 2 && static_cast<double>(at_ns - sights[1].pose().at_ns) * 1e-9 > velocity_over_s)
    sights.pop_front();
  if (sights.size() > most_sights)
    sights.pop_front();
  if (pose->height_m < settings.min_height_m)
    return unusable::too_low;
  const double off_nadir = sights.back().off_nadir_rad(width / 2.0, height / 2.0);
  return off_nadir > settings.max_off_nadir_deg * std::numbers::pi / 180 ? unusable::too_oblique : unusable::none;
}

Eigen::Vector3d detector::parts::camera_velocity() const {
  const double dt_s = static_cast<double>(sights.back().pose().at_ns - sights.front().pose().at_ns) * 1e-9;
  return dt_s < 0.05 ? Eigen::Vector3d::Zero().eval()
                     : (way_between(sights.front().pose(), sights.back().pose()) / dt_s).eval();
}

void detector::parts::mark_parallax() {
  if (sights.size() < 2)
    return;
  const Eigen::Vector3d velocity = camera_velocity();
  for (auto& each : tracks.tracks()) {
    if (each.missed > 0)
      continue;
    const auto at = each.filter.place();
    const auto by = each.filter.velocity();
    if (is_like_parallax(sights.back(), velocity, reduction * Eigen::Vector2d(at.x, at.y),
                         reduction * Eigen::Vector2d(by.x, by.y)))
      ++each.along_parallax;
  }
}

std::optional<still_reach> detector::parts::reach_at(const cv::Point2d& place) const {
  const auto still = still_motion_at(sights.back(), camera_velocity(), reduction * Eigen::Vector2d(place.x, place.y));
  if (!still)
    return std::nullopt;
  return still_reach{{still->fastest_px_s.x() / reduction, still->fastest_px_s.y() / reduction},
                     sway_m * still->pixels_a_metre / reduction};
}

unusable detector::parts::find(const frame_view& frame, const cv::Mat& now, verdict& said) {
  cv::Mat smooth;
  cv::GaussianBlur(now, smooth, cv::Size(3, 3), 0.7);
  // Automatic exposure is a factor, and optical flow takes the ground for equally bright in both pictures.
  const double gain = std::clamp(even_brightness / std::max(said.figures.brightness, 1.0), 0.5, 4.0);
  smooth.convertTo(smooth, CV_8U, gain);
  std::optional<cv::Matx33d> guess;
  if (found_from && !sights.empty())
    guess = scaled_down(ground_homography(*found_from, sights.back()), reduction);
  const auto moved_by = motion.step(smooth, guess);
  look_figures& figures = said.figures;
  figures.features = moved_by.features;
  figures.inliers = moved_by.inliers;
  figures.residual_px = moved_by.residual_px * reduction;
  if (motion.is_waiting())
    return moved_by.why;
  found_from = sights.empty() ? std::nullopt : std::optional(sights.back());
  const double dt_s = static_cast<double>(last_ns - found_ns) * 1e-9;
  found_ns = last_ns;
  if (moved_by.why != unusable::none) {
    const bool is_first = pictures == 0;
    stands.lose();
    change.forget();
    background.forget();
    clutter.forget();
    proof.forget();
    tracks.forget();
    pictures = 1;
    return is_first ? unusable::starting : moved_by.why;
  }
  const cv::Matx33d full = scaled_up(moved_by.before_to_now, reduction);
  figures.homography.emplace();
  std::copy_n(full.val, 9, figures.homography->begin());
  figures.corner_shift_px = corner_shift(full, cv::Size(width, height));
  const cv::Matx33d& before_to_now = moved_by.before_to_now;
  stands.step(smooth, dt_s, before_to_now);
  const auto followed = tracks.confirmed_boxes(before_to_now);
  // What may be drawn into the picture begins nothing, and is part of what is followed already.
  const auto blobs_of = [&](cv::Mat mask, blob_source from) {
    stands.clear(mask);
    blobs_found found = find_blobs(mask, from);
    std::erase_if(found.blobs, [&](const blob& each) {
      return stands.may_stand(each.box) &&
             std::ranges::none_of(followed, [&](const cv::Rect2d& box) { return box.contains(middle_of(each.box)); });
    });
    return found;
  };
  const auto background_blobs = blobs_of(background.look(smooth, before_to_now), blob_source::background);
  figures.changed_share = background_blobs.changed_share;
  clutter.step(background_blobs.blobs, dt_s, before_to_now, now.size());
  change.add(smooth, dt_s, before_to_now);
  const int least = static_cast<int>(std::lround(least_change * std::max(1.0, gain / free_gain)));
  blobs_found difference;
  blobs_found slow_difference;
  const bool can_prove = sights.size() >= 2;
  if (!can_prove && (!clutter.is_calm() || tracks.needs_differences())) {
    difference = blobs_of(change.find(recent_change::quick_s, least), blob_source::difference);
    slow_difference = blobs_of(change.find(recent_change::slow_s, least), blob_source::slow_difference);
  }
  proof.add(smooth, dt_s, before_to_now);
  tracker::prover proves;
  if (can_prove)
    proves = [this](const track& who) {
      const auto still = reach_at(who.filter.place());
      return still && proof.has_moved(who, *still);
    };
  tracks.step({background_blobs.blobs, difference.blobs, slow_difference.blobs}, clutter, dt_s, before_to_now,
              now.size(), proves);
  if (questions)
    questions->step(tracks.tracks(), frame, reduction, figures.brightness, dt_s);
  mark_parallax();
  figures.tracks = static_cast<int>(tracks.tracks().size());
  figures.coasting =
      static_cast<int>(std::ranges::count_if(tracks.tracks(), [](const track& t) { return t.missed > 0; }));
  ++pictures;
  if (!change.is_ready())
    return unusable::starting;
  if (figures.changed_share > settings.max_changed_share)
    return unusable::too_many_movers;
  return unusable::none;
}

std::optional<unsaid_reason> detector::parts::why_unsaid(const track& who, const pixel_box& box) const {
  if (!who.is_confirmed)
    return unsaid_reason::young;
  if (who.missed > most_coasting)
    return unsaid_reason::lost;
  if (who.is_double)
    return unsaid_reason::part;
  if (is_parallax(who))
    return unsaid_reason::high;
  if (who.looks.is_surely_unlike())
    return unsaid_reason::unlike;
  if (std::max(box.width_px, box.height_px) < settings.min_size_px)
    return unsaid_reason::small;
  return std::nullopt;
}

void detector::parts::say(verdict& said) const {
  for (const auto& each : tracks.tracks()) {
    const auto recognised = each.looks.extent();
    const cv::Rect2d reduced_box = recognised ? *recognised + each.filter.place() : extent_of(each);
    const pixel_box box{reduced_box.x * reduction, reduced_box.y * reduction, reduced_box.width * reduction,
                        reduced_box.height * reduction};
    if (const auto why = why_unsaid(each, box)) {
      said.figures.unsaid.push_back({each.number, box, *why});
      continue;
    }
    candidate made;
    made.track = each.number;
    made.box = box;
    made.speed_px_s = cv::norm(each.filter.velocity()) * reduction;
    made.confidence = static_cast<double>(each.seen) / (each.age + 2);
    made.frames_seen = each.seen;
    made.is_seen_now = each.missed == 0;
    made.looks_like = each.looks.what();
    if (!sights.empty())
      made.place = ground_point(sights.back(), made.box, settings.max_off_nadir_deg * std::numbers::pi / 180);
    said.confirmed.push_back(made);
  }
}

std::optional<std::string> problem_of(const detector_settings& settings) {
  if (settings.camera)
    if (auto wrong = problem_of(*settings.camera))
      return "camera: " + *wrong;
  struct range {
    const char* name;
    double value;
    double least;
    double most;
  };
  for (const auto& each : {range{"working_width_px", static_cast<double>(settings.working_width_px), 64, 2048},
                           range{"frames_to_confirm", static_cast<double>(settings.frames_to_confirm), 2, 60},
                           range{"min_size_px", settings.min_size_px, 2, 500},
                           range{"max_tracks", static_cast<double>(settings.max_tracks), 1, 500},
                           range{"max_off_nadir_deg", settings.max_off_nadir_deg, 5, 80},
                           range{"min_height_m", settings.min_height_m, 0, 1000},
                           range{"max_changed_share", settings.max_changed_share, 0.01, 1}})
    if (!(each.value >= each.least && each.value <= each.most)) // also when it is not a number
      return std::string(each.name) + " is " + std::to_string(each.value) + ", and must be from " +
             std::to_string(each.least) + " to " + std::to_string(each.most);
  return std::nullopt;
}

void use_one_thread() { cv::setNumThreads(1); }

void keep_freed_memory() {
  constexpr int largest_kept = 32 << 20; // the most that glibc takes
  constexpr int kept_free = 64 << 20;
  ::mallopt(M_MMAP_THRESHOLD, largest_kept);
  ::mallopt(M_TRIM_THRESHOLD, kept_free);
}

frame_view view_of(const io::video::frame& picture, std::int64_t captured_ns) {
  const auto& [grey, blue, red] = picture.planes;
  return {grey.pixels, picture.width, picture.height, grey.stride, captured_ns, blue.pixels, red.pixels, blue.stride};
}

detector::detector(const detector_settings& settings, const std::shared_ptr<classifier>& asked)
    : parts_(std::make_unique<parts>(settings, asked)) {
  const auto wrong = problem_of(settings);
  GODWIT_ASSERT(!wrong, "settings of a detector that were not checked: " + wrong.value_or(""));
}

detector::~detector() = default;

verdict detector::look(const frame_view& frame, const std::optional<camera_pose>& pose) {
  const std::int64_t begin = thread_ns();
  verdict said = parts_->look(frame, pose);
  said.figures.microseconds = (thread_ns() - begin) / 1'000;
  return said;
}

} // namespace godwit::eyes
