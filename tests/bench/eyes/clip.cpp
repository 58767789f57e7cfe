#include "tests/bench/eyes/clip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <optional>

#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/background_segm.hpp>

#include "programs/godwit-eyes/detection/own_motion.hpp"
#include "programs/godwit-eyes/look/drawing.hpp"
#include "programs/godwit-eyes/look/look_files.hpp"
#include "programs/godwit-sim/camera/random.hpp"
#include "tests/support/eyes/naive_detector.hpp"

namespace godwit::eyes::test {

namespace {

const cv::Size seen_size(640, 480); // of a clip of 768 x 576
constexpr double frame_s = 0.1;
constexpr int first_scored = 45; // the first labelled frame; by then all three know the ground

// -- the camera

// From a pixel of the clip to one of the picture, at a time. The picture stays within the clip.
class camera_motion {
public:
  explicit camera_motion(std::uint64_t seed) {
    sim::camera::random_source random(seed);
    for (auto& each : waves_)
      each = {random.between(4, 7), random.between(0, 2 * std::numbers::pi)};
  }
  [[nodiscard]] cv::Matx33d at(double time_s) const {
    const double x = 384 + 44 * wave(0, time_s) + shake(time_s);
    const double y = 288 + 28 * wave(1, time_s) - shake(time_s);
    const double turn = 1.5 * std::numbers::pi / 180 * wave(2, time_s);
    const double zoom = 1.01 + 0.02 * wave(3, time_s);
    const double c = zoom * std::cos(turn);
    const double s = zoom * std::sin(turn);
    const cv::Matx33d turned(c, -s, 0, s, c, 0, 1e-5 * wave(4, time_s), 1e-5 * wave(5, time_s), 1);
    return cv::Matx33d(1, 0, seen_size.width / 2.0, 0, 1, seen_size.height / 2.0, 0, 0, 1) * turned *
           cv::Matx33d(1, 0, -x, 0, 1, -y, 0, 0, 1);
  }

private:
  struct wave_of {
    double period_s;
    double phase;
  };
  [[nodiscard]] double wave(std::size_t which, double time_s) const {
    return std::sin(2 * std::numbers::pi * time_s / waves_.at(which).period_s + waves_.at(which).phase);
  }
  [[nodiscard]] static double shake(double time_s) { return std::sin(2 * std::numbers::pi * 1.3 * time_s); }
  std::array<wave_of, 6> waves_{};
};

cv::Rect2d moved_box(const cv::Matx33d& by, const cv::Rect2d& box) {
  double left = 1e9;
  double top = 1e9;
  double right = -1e9;
  double bottom = -1e9;
  for (const auto& corner : {box.tl(), box.br(), cv::Point2d(box.br().x, box.y), cv::Point2d(box.x, box.br().y)}) {
    const auto at = moved(by, corner);
    left = std::min(left, at.x);
    right = std::max(right, at.x);
    top = std::min(top, at.y);
    bottom = std::max(bottom, at.y);
  }
  return {left, top, right - left, bottom - top};
}

// -- what is to be found

struct label {
  cv::Rect2d box; // in the clip
  bool counts = true;
};
using frame_labels = std::map<int, std::vector<label>>;

tl::expected<frame_labels, std::string> read_labels(const std::string& path) {
  std::ifstream file(path);
  const auto all = nlohmann::json::parse(file, nullptr, false);
  if (all.is_discarded() || !all.contains("frames"))
    return tl::make_unexpected(path + " can not be read, or is no file of labels");
  frame_labels result;
  for (const auto& frame : all["frames"]) {
    auto& to = result[frame.at("frame").get<int>()];
    for (const auto& each : frame.at("movers")) {
      const auto box = each.at("box").get<std::array<double, 4>>();
      to.push_back({{box[0], box[1], box[2], box[3]}, !each.contains("left_out")});
    }
  }
  return result;
}

// As truth of a picture of SIZE, after BY.
sim::camera::truth truth_of(const std::vector<label>& labels, const cv::Matx33d& by, const cv::Size& size) {
  constexpr double fast = 1000;
  const cv::Rect2d inside(0, 0, size.width, size.height);
  sim::camera::truth result;
  for (const auto& each : labels) {
    const auto box = moved_box(by, each.box);
    const auto part = box & inside;
    if (part.area() < 1)
      continue;
    sim::camera::true_mover made;
    made.x_px = part.x;
    made.y_px = part.y;
    made.width_px = part.width;
    made.height_px = part.height;
    made.is_cut = part.area() < box.area() - 1;
    made.visible_share = each.counts ? 1 : 0;
    made.speed_px_s = fast;
    result.movers.push_back(std::move(made));
  }
  return result;
}

// What MOG2 says of the clip itself, as it comes, with its holes closed; shadows are left out.
class still_detector {
public:
  [[nodiscard]] std::vector<label> look(const cv::Mat& clip_frame) {
    constexpr int least_area = 100;
    constexpr std::uint8_t surely = 255;
    cv::Mat mask;
    ground_->apply(clip_frame, mask);
    mask = mask == surely;
    cv::medianBlur(mask, mask, 3);
    cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_RECT, cv::Size(7, 7)));
    cv::Mat labels;
    cv::Mat stats;
    cv::Mat middles;
    const int count = cv::connectedComponentsWithStats(mask, labels, stats, middles);
    std::vector<label> found;
    for (int n = 1; n < count; ++n)
      if (stats.at<int>(n, cv::CC_STAT_AREA) >= least_area)
        found.push_back({cv::Rect2d(stats.at<int>(n, cv::CC_STAT_LEFT), stats.at<int>(n, cv::CC_STAT_TOP),
                                    stats.at<int>(n, cv::CC_STAT_WIDTH), stats.at<int>(n, cv::CC_STAT_HEIGHT))});
    return found;
  }

private:
  cv::Ptr<cv::BackgroundSubtractorMOG2> ground_ = cv::createBackgroundSubtractorMOG2();
};

void add(const sim::camera::truth& real, const std::vector<pixel_box>& seen, const cv::Size& size, pair_of_scores& to) {
  score_rules rules;
  rules.width = size.width;
  rules.height = size.height;
  rules.overlap = 0.5;
  to.half += score_of(real, seen, rules);
  rules.overlap = 0.25;
  to.quarter += score_of(real, seen, rules);
}

std::vector<pixel_box> boxes_of(const std::vector<label>& found) {
  std::vector<pixel_box> boxes;
  for (const auto& each : found)
    boxes.push_back({each.box.x, each.box.y, each.box.width, each.box.height});
  return boxes;
}

std::vector<pixel_box> boxes_of(const verdict& said) {
  std::vector<pixel_box> boxes;
  for (const auto& each : said.confirmed)
    boxes.push_back(each.box);
  return boxes;
}

// -- all of it

class measurement {
public:
  measurement(const clip_options& options, frame_labels labels)
      : options_(options), labels_(std::move(labels)), motion_(options.seed) {}

  void look(const cv::Mat& clip_frame) {
    const int number = figures_.frames++;
    const cv::Matx33d by = motion_.at(number * frame_s);
    cv::Mat seen;
    cv::warpPerspective(clip_frame, seen, by, seen_size, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
    const frame_view view{seen.data, seen.cols, seen.rows, seen.step, (number + 1) * 100'000'000LL};
    const auto said = detector_.look(view, std::nullopt);
    const auto first = naive_.look(view);
    const auto still = mog2_.look(clip_frame);
    ways_.add(said);
    figures_.milliseconds.push_back(static_cast<double>(said.figures.microseconds) * 1e-3);
    figures_.usable += said.why == unusable::none ? 1 : 0;
    if (number > 0)
      add_motion(by * motion_.at((number - 1) * frame_s).inv(), said);
    if (const auto known = labels_.find(number); known != labels_.end()) {
      ++figures_.labelled;
      const auto real = truth_of(known->second, by, seen_size);
      add(real, boxes_of(said), seen_size, figures_.detector);
      add(real, first, seen_size, figures_.naive);
      add(truth_of(known->second, cv::Matx33d::eye(), clip_frame.size()), boxes_of(still), clip_frame.size(),
          figures_.still);
      draw(number, view, said, real);
    } else if (number >= first_scored) {
      ++figures_.rest_frames;
      add(truth_of(still, by, seen_size), boxes_of(said), seen_size, figures_.rest);
    }
  }
  [[nodiscard]] const clip_figures& figures() const { return figures_; }

private:
  void add_motion(const cv::Matx33d& real, const verdict& said) {
    figures_.fastest_px = std::max(figures_.fastest_px, corner_shift(real, seen_size));
    if (!said.figures.homography)
      return;
    const cv::Matx33d found(said.figures.homography->data());
    for (const auto& corner :
         {cv::Point2d(0, 0), cv::Point2d(seen_size.width - 1, 0), cv::Point2d(0, seen_size.height - 1),
          cv::Point2d(seen_size.width - 1, seen_size.height - 1)})
      figures_.corner_errors_px.push_back(cv::norm(moved(found, corner) - moved(real, corner)));
  }
  void draw(int number, const frame_view& view, const verdict& said, const sim::camera::truth& real) const {
    if (options_.folder.empty())
      return;
    cv::Mat picture = drawn(view, said, ways_, {static_cast<std::uint64_t>(number), number * frame_s});
    for (const auto& each : real.movers)
      cv::rectangle(picture, cv::Rect2d(each.x_px, each.y_px, each.width_px, each.height_px), cv::Scalar(255, 0, 0));
    std::filesystem::create_directories(options_.folder);
    std::array<char, 24> name{};
    std::snprintf(name.data(), name.size(), "/clip-%03d.png", number);
    if (const auto written = write_png(options_.folder + name.data(), picture); !written)
      std::fprintf(stderr, "%s\n", written.error().c_str());
  }

  clip_options options_;
  frame_labels labels_;
  camera_motion motion_;
  detector detector_{detector_settings{}};
  naive_detector naive_{tuned_naive};
  still_detector mog2_;
  trails ways_;
  clip_figures figures_;
};

} // namespace

tl::expected<clip_figures, std::string> measure_clip(const clip_options& options) {
  auto labels = read_labels(options.labels);
  if (!labels)
    return tl::make_unexpected(labels.error());
  measurement all(options, std::move(*labels));
  picture_reader reader(io::video::recording_at(options.clip));
  while (const auto frame = reader.next()) {
    if (frame->width != 768 || frame->height != 576)
      return tl::make_unexpected(options.clip + " has another size than 768 x 576: it is not the clip of the labels");
    const auto& grey = frame->planes[0];
    all.look(cv::Mat(frame->height, frame->width, CV_8UC1, const_cast<std::uint8_t*>(grey.pixels), grey.stride));
  }
  if (!reader.problem().empty())
    return tl::make_unexpected(reader.problem());
  return all.figures();
}

} // namespace godwit::eyes::test
