#include "tests/bench/eyes/recordings.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "programs/godwit-eyes/detection/classifier.hpp"
#include "programs/godwit-eyes/look/drawing.hpp"
#include "programs/godwit-eyes/look/look_files.hpp"
#include "tests/bench/eyes/measure.hpp"

namespace godwit::eyes::test {

namespace {

namespace fs = std::filesystem;

constexpr int recording_drawn_every = 10;
constexpr std::int64_t ns_in_s = 1'000'000'000;

tl::expected<std::string, std::string> recording_of(const fs::path& labels) {
  for (const auto& each : fs::directory_iterator(labels.parent_path()))
    if (each.path().stem() == labels.stem() && each.path().extension() != ".json" &&
        each.path().extension() != ".ground")
      return fs::absolute(each.path()).string();
  return tl::make_unexpected("there is no recording beside it: " + labels.stem().string() + ".mkv, or another ending");
}

cv::Matx33d motion_between(const cv::Mat& before, const cv::Mat& now) {
  constexpr int most_corners = 600;
  constexpr std::size_t fewest_corners = 12;
  std::vector<cv::Point2f> from;
  cv::goodFeaturesToTrack(before, from, most_corners, 0.01, 8);
  if (from.size() < fewest_corners)
    return cv::Matx33d::eye();
  std::vector<cv::Point2f> to;
  std::vector<std::uint8_t> is_tracked;
  std::vector<float> error;
  cv::calcOpticalFlowPyrLK(before, now, from, to, is_tracked, error);
  std::vector<cv::Point2f> kept_from;
  std::vector<cv::Point2f> kept_to;
  for (std::size_t n = 0; n < from.size(); ++n)
    if (is_tracked[n] != 0) {
      kept_from.push_back(from[n]);
      kept_to.push_back(to[n]);
    }
  if (kept_from.size() < fewest_corners)
    return cv::Matx33d::eye();
  const cv::Mat found = cv::findHomography(kept_from, kept_to, cv::RANSAC, 1.5);
  return found.empty() ? cv::Matx33d::eye() : cv::Matx33d(found);
}

// Kept in a file for the next time: it takes longer than the detector.
class ground_motion {
public:
  explicit ground_motion(fs::path kept) : kept_(std::move(kept)) {
    std::ifstream file(kept_);
    cv::Matx33d each;
    while (std::all_of(each.val, each.val + 9, [&](double& value) { return static_cast<bool>(file >> value); }))
      all_.push_back(each);
    is_known_ = !all_.empty();
  }
  void add(const cv::Mat& now) {
    if (is_known_)
      return;
    all_.push_back(before_.empty() ? cv::Matx33d::eye() : motion_between(before_, now));
    now.copyTo(before_);
  }
  [[nodiscard]] const std::vector<cv::Matx33d>& all() const { return all_; }
  void keep() const {
    if (is_known_)
      return;
    std::ofstream file(kept_);
    file.precision(12);
    for (const auto& each : all_) {
      for (const double value : each.val)
        file << value << ' ';
      file << '\n';
    }
  }

private:
  fs::path kept_;
  std::vector<cv::Matx33d> all_;
  cv::Mat before_;
  bool is_known_ = false;
};

void draw_recording(const std::string& folder, const std::string& name, int number, const cv::Mat& picture) {
  std::array<char, 32> ending{};
  std::snprintf(ending.data(), ending.size(), "-%04d.png", number);
  fs::create_directories(folder);
  if (const auto written = write_png(folder + "/" + name + ending.data(), picture); !written)
    std::fprintf(stderr, "%s\n", written.error().c_str());
}

void add_labels(const clip_labels& labels, int number, cv::Mat& picture) {
  const auto known = labels.pictures.find(number);
  if (known == labels.pictures.end())
    return;
  for (const auto& each : known->second.movers)
    cv::rectangle(picture, each.box, cv::Scalar(255, 0, 0));
}

tl::expected<recording_figures, std::string> measured_recording(const fs::path& path, const std::string& folder,
                                                                const std::shared_ptr<classifier>& asked) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  const auto labels = parse_clip_labels(text.str());
  if (!labels)
    return tl::make_unexpected(labels.error());
  const auto recording = recording_of(path);
  if (!recording)
    return tl::make_unexpected(recording.error());
  recording_figures result;
  result.name = path.stem().string();
  ground_motion ground(fs::path(path).replace_extension(".ground"));
  detector eyes{detector_settings{}, asked};
  clip_detections found;
  trails ways;
  picture_reader reader(io::video::recording_at(*recording));
  std::int64_t last_ns = 0;
  for (int number = 1; const auto picture = reader.next(); ++number) {
    const auto& grey = picture->planes[0];
    last_ns = std::max(picture->stream_ns + ns_in_s, last_ns + 1);
    const frame_view view = view_of(*picture, last_ns);
    const auto seen = eyes.look(view, std::nullopt);
    ways.add(seen);
    found.size = cv::Size(picture->width, picture->height);
    ground.add(cv::Mat(picture->height, picture->width, CV_8UC1, const_cast<std::uint8_t*>(grey.pixels), grey.stride));
    result.milliseconds.push_back(static_cast<double>(seen.figures.microseconds) * 1e-3);
    if (seen.why != unusable::none)
      ++result.reasons[std::string(name_of(seen.why))];
    found.is_usable[number] = seen.why == unusable::none;
    for (const auto& each : seen.confirmed)
      found.boxes[number].push_back(
          {each.track, {each.box.x_px, each.box.y_px, each.box.width_px, each.box.height_px}});
    if (folder.empty() || number % recording_drawn_every != 0)
      continue;
    cv::Mat picture_drawn = drawn(view, seen, ways, {static_cast<std::uint64_t>(number), 0});
    add_labels(*labels, number, picture_drawn);
    draw_recording(folder, result.name, number, picture_drawn);
  }
  if (!reader.problem().empty())
    return tl::make_unexpected(reader.problem());
  ground.keep();
  result.score = score_of(*labels, ground.all(), found);
  return result;
}

// The mean over clips, with the interval in which nine of ten means of clips drawn anew lie (bootstrap).
struct mean_figure {
  double mean = 0;
  double low = 0;
  double high = 0;
};

mean_figure mean_of(const std::vector<double>& values) {
  constexpr int rounds = 2000;
  const auto count = values.size();
  std::vector<double> means;
  std::uint32_t state = 1;
  for (int n = 0; n < rounds; ++n) {
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) {
      state = state * 1664525U + 1013904223U; // Numerical Recipes; the same numbers each time
      sum += values[(state >> 8U) % count];
    }
    means.push_back(sum / static_cast<double>(count));
  }
  double sum = 0;
  for (const double each : values)
    sum += each;
  return {sum / static_cast<double>(count), quantile(means, 0.05), quantile(means, 0.95)};
}

} // namespace

tl::expected<std::vector<recording_figures>, std::string>
measure_recordings(const std::string& folder, const std::string& draw, const std::string& model) {
  use_one_thread();
  std::shared_ptr<classifier> asked;
  if (!model.empty()) {
    auto made = io::eyes::read_model(model).and_then(classifier::make);
    if (!made)
      return tl::make_unexpected(std::move(made.error()));
    asked = *std::move(made);
  }
  std::error_code failed;
  std::vector<fs::path> labels;
  for (const auto& each : fs::directory_iterator(folder, failed))
    if (each.path().extension() == ".json")
      labels.push_back(each.path());
  if (failed)
    return tl::make_unexpected(folder + ": " + failed.message());
  if (labels.empty())
    return tl::make_unexpected(folder + " holds no labels (NAME.json)");
  std::ranges::sort(labels);
  std::vector<recording_figures> result;
  for (const auto& each : labels) {
    auto measured = measured_recording(each, draw, asked);
    if (!measured)
      return tl::make_unexpected(each.string() + ": " + measured.error());
    result.push_back(*std::move(measured));
  }
  return result;
}

void print_recordings(const std::vector<recording_figures>& all) {
  std::printf(
      "| clip | F1 by overlap / by middles | precision, recall by middles | movers found | false tracks a minute "
      "| of use | ms p50 / p99; mean | not of use |\n|---|---|---|---|---|---|---|---|\n");
  std::vector<double> by_overlap;
  std::vector<double> by_middle;
  std::vector<double> false_tracks;
  double least_use = 1;
  for (const auto& each : all) {
    const auto& s = each.score;
    std::printf("| %s | %.3f / %.3f | %.2f, %.2f | %d of %d | %.1f | %.0f %% | %.1f / %.1f; %.1f |", each.name.c_str(),
                s.by_overlap.f1(), s.by_middle.f1(), s.by_middle.precision(), s.by_middle.recall(), s.movers_found,
                s.movers, s.false_tracks_per_min, s.usable_share * 100, quantile(each.milliseconds, 0.5),
                quantile(each.milliseconds, 0.99), mean_of(each.milliseconds).mean);
    for (const auto& [name, count] : each.reasons)
      std::printf(" %s %d", name.c_str(), count);
    std::printf(" |\n");
    by_overlap.push_back(s.by_overlap.f1());
    by_middle.push_back(s.by_middle.f1());
    false_tracks.push_back(s.false_tracks_per_min);
    least_use = std::min(least_use, s.usable_share);
  }
  const auto overlap = mean_of(by_overlap);
  const auto middle = mean_of(by_middle);
  const auto wrong = mean_of(false_tracks);
  std::printf("| mean [90 %%] | %.3f [%.3f %.3f] / %.3f [%.3f %.3f] | | | %.1f [%.1f %.1f] | least %.0f %% | | |\n",
              overlap.mean, overlap.low, overlap.high, middle.mean, middle.low, middle.high, wrong.mean, wrong.low,
              wrong.high, least_use * 100);
}

} // namespace godwit::eyes::test
