#include "programs/godwit-eyes/session/picture_maker.hpp"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "io/video/jpeg_encoder.hpp"

namespace godwit::eyes {

struct picture_maker::parts {
  io::eyes::picture_slot* slot = nullptr;
  std::unique_ptr<io::video::recorder> records;

  mutable std::mutex mutex;
  std::condition_variable changed;
  std::optional<io::video::frame> waiting;
  std::int64_t wanted_until_ns = 0;
  std::int64_t gap_ns = 0;
  picture_report now;
  bool is_ending = false;
  std::thread thread;

  // Of the thread.
  std::int64_t shown_ns = 0;
  std::int64_t recorded_ns = 0;

  void run() {
    io::video::jpeg_encoder encoder(quality);
    for (std::unique_lock lock(mutex);;) {
      changed.wait(lock, [this] { return is_ending || waiting; });
      if (is_ending)
        return;
      const auto picture = *std::exchange(waiting, std::nullopt);
      const auto at = picture.captured_ns;
      const bool shows = slot != nullptr && at < wanted_until_ns && at - shown_ns >= gap_ns;
      const bool keeps = records && at - recorded_ns >= record_gap_ns;
      if (!shows && !keeps)
        continue;
      lock.unlock();
      make(encoder, picture, shows, keeps);
      lock.lock();
    }
  }

  void make(io::video::jpeg_encoder& encoder, const io::video::frame& picture, bool shows, bool keeps) {
    const auto jpeg = encoder.encode(picture);
    if (!jpeg)
      return;
    const bool is_shown = shows && slot->publish(*jpeg, picture.captured_ns, picture.width, picture.height);
    if (shows)
      shown_ns = picture.captured_ns;
    if (keeps) {
      recorded_ns = picture.captured_ns;
      records->add(*jpeg, picture.captured_ns, picture.width, picture.height);
    }
    const std::lock_guard guard(mutex);
    if (is_shown)
      ++now.shown;
    if (keeps) {
      now.recorded_bytes = records->report().bytes;
      now.record_error = records->report().error;
    }
  }
};

picture_maker::picture_maker(io::eyes::picture_slot* slot, std::optional<io::video::recorder_settings> records)
    : parts_(std::make_unique<parts>()) {
  parts_->slot = slot;
  if (records)
    parts_->records = std::make_unique<io::video::recorder>(*std::move(records));
  parts_->thread = std::thread([all = parts_.get()] { all->run(); });
}

picture_maker::~picture_maker() {
  {
    const std::lock_guard guard(parts_->mutex);
    parts_->is_ending = true;
  }
  parts_->changed.notify_all();
  parts_->thread.join();
}

void picture_maker::want(std::int64_t until_ns, std::int64_t gap_ns) {
  const std::lock_guard guard(parts_->mutex);
  parts_->wanted_until_ns = until_ns;
  parts_->gap_ns = gap_ns;
}

void picture_maker::offer(const io::video::frame& picture) {
  {
    const std::lock_guard guard(parts_->mutex);
    const bool is_wanted = parts_->records || picture.captured_ns < parts_->wanted_until_ns;
    if (!is_wanted)
      return;
    parts_->waiting = picture;
  }
  parts_->changed.notify_all();
}

picture_report picture_maker::report() const {
  const std::lock_guard guard(parts_->mutex);
  return parts_->now;
}

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
