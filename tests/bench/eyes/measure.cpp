#include "tests/bench/eyes/measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <optional>
#include <set>

#include <Eigen/LU>

#include "programs/godwit-eyes/detection/detector.hpp"
#include "programs/godwit-eyes/detection/thread_time.hpp"
#include "programs/godwit-eyes/ground/sight.hpp"
#include "programs/godwit-eyes/look/drawing.hpp"
#include "programs/godwit-eyes/look/look_files.hpp"
#include "programs/godwit-sim/camera/ground_painter.hpp"
#include "programs/godwit-sim/camera/random.hpp"
#include "tests/support/eyes/naive_detector.hpp"
#include "tests/support/eyes/pose_of_view.hpp"

namespace godwit::eyes::test {

namespace {

using sim::camera::suite_case;

constexpr int not_scored = 30;
constexpr int drawn_every = 15;
constexpr sim::camera::vector3 attitude_error{0.010, -0.008, 0.006};

void add_scores(const sim::camera::truth& real, const std::vector<pixel_box>& boxes, score_rules rules, score& half,
                score& quarter) {
  rules.overlap = 0.5;
  half += score_of(real, boxes, rules);
  rules.overlap = 0.25;
  quarter += score_of(real, boxes, rules);
}

// Where the corners really go, against where the homography says.
void add_corner_errors(const suite_case& flight, int frame, const std::array<double, 9>& h, std::vector<double>& to) {
  const auto& glass = flight.maker().glass();
  const sim::camera::row_views before(glass, flight.view_at((frame - 1) * suite_case::frame_s));
  const sim::camera::row_views now(glass, flight.view_at(frame * suite_case::frame_s));
  for (const double x : {0.0, glass.width - 1.0})
    for (const double y : {0.0, glass.height - 1.0}) {
      const auto place = ground_at(flight.maker().world(), before, x, y);
      const auto there = place ? now.project(*place) : std::nullopt;
      if (!there)
        continue;
      const double w = h[6] * x + h[7] * y + h[8];
      to.push_back(
          std::hypot((h[0] * x + h[1] * y + h[2]) / w - there->x, (h[3] * x + h[4] * y + h[5]) / w - there->y));
    }
}

// FOLDER/b-0011-030.png: tier, seed and picture.
void draw(const std::string& folder, sim::camera::tier which, std::uint64_t seed, int frame, const cv::Mat& picture) {
  std::array<char, 40> name{};
  std::snprintf(name.data(), name.size(), "/%c-%04llu-%03d.png", which == sim::camera::tier::a ? 'a' : 'b',
                static_cast<unsigned long long>(seed), frame);
  std::filesystem::create_directories(folder);
  if (const auto written = write_png(folder + name.data(), picture); !written)
    std::fprintf(stderr, "%s\n", written.error().c_str());
}

struct naive_pair {
  naive_detector first;
  naive_detector tuned{tuned_naive};
};

} // namespace

void measure(std::uint64_t seed, sim::camera::tier which, const measure_options& options, measured& sum) {
  const suite_case flight(seed, which, options.scene);
  detector_settings settings;
  if (options.has_pose)
    settings.camera = parameters_of(flight.maker().glass());
  detector eyes(settings);
  naive_pair naive;
  score_rules rules;
  rules.width = options.scene.width;
  rules.height = options.scene.height;
  std::set<std::uint32_t> numbers;
  trails ways;
  for (int n = 0; n < options.frames; ++n) {
    const auto taken = flight.frame(n);
    const frame_view frame{taken.seen.grey.data(), taken.seen.width, taken.seen.height,
                           static_cast<std::size_t>(taken.seen.width), (n + 1) * 33'333'333LL};
    std::optional<camera_pose> pose;
    if (options.has_pose)
      pose = pose_of(taken.real.view, frame.captured_ns, attitude_error);
    const auto said = eyes.look(frame, pose);
    ways.add(said);
    if (!options.folder.empty() && n % drawn_every == 0)
      draw(options.folder, which, seed, n,
           drawn(frame, said, ways, {static_cast<std::uint64_t>(n), n * suite_case::frame_s}));
    sum.milliseconds.push_back(static_cast<double>(said.figures.microseconds) * 1e-3);
    ++sum.reasons[std::string(name_of(said.why))];
    ++sum.frames;
    std::vector<pixel_box> boxes;
    for (const auto& each : said.confirmed) {
      boxes.push_back(each.box);
      numbers.insert(each.track);
    }
    if (n > 0 && said.figures.homography)
      add_corner_errors(flight, n, *said.figures.homography, sum.corner_errors_px);
    if (n >= not_scored)
      add_scores(taken.real, boxes, rules, sum.at_half, sum.at_quarter);
    if (!options.has_naive || n < not_scored - 1)
      continue;
    const double begin = thread_ms();
    const auto first = naive.first.look(frame);
    sum.naive_milliseconds.push_back(thread_ms() - begin);
    const auto tuned = naive.tuned.look(frame);
    if (n >= not_scored) {
      add_scores(taken.real, first, rules, sum.naive_half, sum.naive_quarter);
      add_scores(taken.real, tuned, rules, sum.tuned_half, sum.tuned_quarter);
    }
  }
  sum.tracks += static_cast<int>(numbers.size());
}

place_figures measure_places(int count) {
  constexpr double one_degree = std::numbers::pi / 180;
  constexpr double limit = 70 * one_degree;
  constexpr double two_deviations = 5.99; // squared, in two dimensions
  const auto camera = camera_from_field_of_view(1280, 720, 60);
  const pixel_box box{630, 350, 20, 20};
  sim::camera::camera_view view;
  view.position = {0, 0, -100};
  view.attitude = sim::camera::rotation_of(0, 45 * one_degree, 0);
  const auto place_with = [&](const sim::camera::vector3& error) {
    auto pose = pose_of(view, 0, error);
    pose.attitude_sd_rad = one_degree;
    pose.position_sd_m = pose.height_sd_m = 0.01;
    return ground_point(sight(camera, pose, 0, camera.width), box, limit).value();
  };
  const auto real = place_with({});
  const auto off = [&](const ground_place& found) {
    const double metres = 6'371'000 * one_degree;
    return Eigen::Vector2d((found.latitude_deg - real.latitude_deg) * metres,
                           (found.longitude_deg - real.longitude_deg) * metres *
                               std::cos(real.latitude_deg * one_degree));
  };
  place_figures result;
  for (int n = 0; n < 360; ++n) {
    const double angle = n * one_degree;
    const auto found = place_with({one_degree * std::cos(angle), one_degree * std::sin(angle), 0});
    result.at_one_degree_m = std::max(result.at_one_degree_m, off(found).norm());
  }
  result.geometry_m = -view.position.z * (std::tan(46 * one_degree) - std::tan(45 * one_degree));
  sim::camera::random_source random(5);
  std::vector<double> distances;
  int inside = 0;
  for (int n = 0; n < count; ++n) {
    const auto found =
        place_with({one_degree * random.gaussian(), one_degree * random.gaussian(), one_degree * random.gaussian()});
    Eigen::Matrix2d covariance;
    covariance << found.variance_north_m2, found.covariance_m2, found.covariance_m2, found.variance_east_m2;
    distances.push_back(off(found).norm());
    inside += off(found).dot(covariance.inverse() * off(found)) < two_deviations ? 1 : 0;
  }
  result.median_m = quantile(distances, 0.5);
  result.share_inside = static_cast<double>(inside) / count;
  return result;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty())
    return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

} // namespace godwit::eyes::test
