#include "programs/godwit-eyes/session/cutout_maker.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace godwit::eyes {

namespace {

// Even numbers: two pixels share their colour. The shape is that of the box with its margin, inside of the picture.
cv::Rect part_around(const io::eyes::box& box, const io::video::frame& in) {
  const double least = cutout_maker::least_side_px;
  const double width = std::max(2 * box.width_px, least);
  const double height = std::max(2 * box.height_px, least);
  const double x = box.x_px + box.width_px / 2 - width / 2;
  const double y = box.y_px + box.height_px / 2 - height / 2;
  const auto even = [](double value) { return static_cast<int>(std::floor(value / 2)) * 2; };
  const cv::Rect whole(0, 0, in.width / 2 * 2, in.height / 2 * 2);
  return cv::Rect(even(x), even(y), even(width), even(height)) & whole;
}

// OpenCV has no view of constant pixels; these are only read.
cv::Mat view_of(const io::video::plane& of, int width, int height) {
  return {height, width, CV_8UC1, const_cast<std::uint8_t*>(of.pixels), of.stride};
}

} // namespace

bool cutout_maker::is_due(std::uint32_t track, std::int64_t now_ns) const {
  const auto& last = made_[track % made_.size()];
  return last.at_ns == 0 || last.track != track || now_ns - last.at_ns >= gap_ns;
}

void cutout_maker::add(const io::eyes::candidates& seen, const io::video::frame& in) {
  int count = 0;
  for (const auto& each : seen.seen) {
    if (count >= most_a_picture)
      return;
    if (!is_due(each.track, seen.captured_ns))
      continue;
    made_[each.track % made_.size()] = {each.track, seen.captured_ns};
    make(each, in);
    ++count;
  }
}

void cutout_maker::make(const io::eyes::candidate& of, const io::video::frame& in) {
  const auto part = part_around(of.where, in);
  if (part.width < 2 || part.height < 2)
    return; // outside of the picture
  const double scale = std::min(1.0, static_cast<double>(most_side_px) / std::max(part.width, part.height));
  const auto half = [scale](int side) { return std::max(1, static_cast<int>(std::lround(side * scale / 2))); };
  const cv::Size colour(half(part.width), half(part.height));
  const cv::Rect part_of_colour(part.x / 2, part.y / 2, part.width / 2, part.height / 2);
  std::array<cv::Mat, 3> planes;
  io::video::frame small;
  small.width = 2 * colour.width;
  small.height = 2 * colour.height;
  for (std::size_t n = 0; n < planes.size(); ++n) {
    const bool is_grey = n == 0;
    const auto whole =
        view_of(in.planes.at(n), is_grey ? in.width : (in.width + 1) / 2, is_grey ? in.height : (in.height + 1) / 2);
    cv::resize(whole(is_grey ? part : part_of_colour), planes.at(n), is_grey ? colour * 2 : colour, 0, 0,
               cv::INTER_AREA);
    small.planes.at(n) = {planes.at(n).data, planes.at(n).step};
  }
  if (const auto jpeg = encoder_.encode(small))
    static_cast<void>(slot_.publish_cutout(of.track, *jpeg, in.captured_ns, small.width, small.height));
}

} // namespace godwit::eyes
