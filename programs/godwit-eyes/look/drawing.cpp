#include "programs/godwit-eyes/look/drawing.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include <opencv2/imgproc.hpp>

#include "programs/godwit-eyes/detection/own_motion.hpp"

namespace godwit::eyes {

namespace {

const cv::Scalar green(40, 230, 60);
const cv::Scalar yellow(240, 220, 40);
const cv::Scalar magenta(240, 60, 220);
const cv::Scalar white(230, 230, 230);
const cv::Scalar blue(60, 140, 255);
const cv::Scalar red(255, 70, 50);
const cv::Scalar black(0, 0, 0);

constexpr int arrows_across = 9;
constexpr int arrows_down = 5;

template <class... Values>
std::string text(const char* format, Values... values) {
  std::array<char, 200> line{};
  std::snprintf(line.data(), line.size(), format, values...);
  return line.data();
}

cv::Rect rounded(const pixel_box& box) {
  return {static_cast<int>(std::lround(box.x_px)), static_cast<int>(std::lround(box.y_px)),
          static_cast<int>(std::lround(box.width_px)), static_cast<int>(std::lround(box.height_px))};
}

// Light on a dark edge, to be read over anything.
void write(cv::Mat& on, const std::string& what, const cv::Point& at, const cv::Scalar& colour, double size) {
  cv::putText(on, what, at, cv::FONT_HERSHEY_SIMPLEX, size, black, 2, cv::LINE_AA);
  cv::putText(on, what, at, cv::FONT_HERSHEY_SIMPLEX, size, colour, 1, cv::LINE_AA);
}

void draw_ground(cv::Mat& on, const std::array<double, 9>& homography) {
  const cv::Matx33d way(homography.data());
  for (int row = 1; row <= arrows_down; ++row)
    for (int column = 1; column <= arrows_across; ++column) {
      const cv::Point2d from(on.cols * column / (arrows_across + 1.0), on.rows * row / (arrows_down + 1.0));
      cv::arrowedLine(on, from, moved(way, from), blue, 1, cv::LINE_AA, 0, 0.25);
    }
}

void draw_said(cv::Mat& on, const verdict& seen, const trails& ways, double size) {
  for (const auto& each : seen.confirmed) {
    const auto& colour = each.is_seen_now ? green : yellow;
    const auto box = rounded(each.box);
    cv::rectangle(on, box, colour, 2);
    const std::string what(each.looks_like == object_class::unknown ? "" : io::name_of(each.looks_like));
    write(on, text("#%u %s %.0f px/s", each.track, what.c_str(), each.speed_px_s), {box.x, box.y - 4}, colour, size);
    const auto way = ways.all().find(each.track);
    for (std::size_t n = 1; way != ways.all().end() && n < way->second.size(); ++n)
      cv::line(on, way->second[n - 1], way->second[n], colour, 1, cv::LINE_AA);
  }
  for (const auto& each : seen.figures.unsaid) {
    cv::rectangle(on, rounded(each.box), each.why == unsaid_reason::high ? magenta : white, 1);
    if (each.why == unsaid_reason::high)
      write(on, "high", {rounded(each.box).x, rounded(each.box).y - 4}, magenta, size);
  }
}

} // namespace

void trails::add(const verdict& seen) {
  if (seen.figures.homography) {
    const cv::Matx33d way(seen.figures.homography->data());
    for (auto& [number, places] : all_)
      for (auto& each : places)
        each = moved(way, each);
  } else {
    all_.clear();
  }
  for (const auto& each : seen.confirmed) {
    auto& places = all_[each.track];
    places.emplace_back(each.box.x_px + each.box.width_px / 2, each.box.y_px + each.box.height_px / 2);
    if (places.size() > max_places)
      places.pop_front();
  }
  if (all_.size() > max_tracks)
    all_.erase(all_.begin());
}

cv::Mat drawn(const frame_view& frame, const verdict& seen, const trails& ways, const picture_label& label) {
  // OpenCV has no view of constant pixels; these are only read.
  const cv::Mat grey(frame.height, frame.width, CV_8UC1, const_cast<std::uint8_t*>(frame.grey), frame.stride);
  cv::Mat on;
  cv::cvtColor(grey, on, cv::COLOR_GRAY2RGB);
  const double size = frame.width >= 1000 ? 0.5 : 0.36;
  const auto& figures = seen.figures;
  if (figures.homography)
    draw_ground(on, *figures.homography);
  draw_said(on, seen, ways, size);
  const int line = frame.width >= 1000 ? 20 : 14;
  auto first = text("%.2f s, picture %llu", label.at_s, static_cast<unsigned long long>(label.number));
  if (seen.why != unusable::none)
    first += text("   NOT USABLE: %s", std::string(sentence_of(seen.why)).c_str());
  write(on, first, {6, line}, seen.why == unusable::none ? white : red, size);
  write(on,
        text("ground: %d of %d features, residual %.2f px, corners moved by %.1f px", figures.inliers, figures.features,
             figures.residual_px, figures.corner_shift_px),
        {6, 2 * line}, blue, size);
  write(on,
        text("reported %zu of %d tracks; %.2f %% of the picture differs; brightness %.0f; %.1f ms",
             seen.confirmed.size(), figures.tracks, figures.changed_share * 100, figures.brightness,
             static_cast<double>(figures.microseconds) * 1e-3),
        {6, 3 * line}, white, size);
  return on;
}

} // namespace godwit::eyes
