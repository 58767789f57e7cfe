#include "programs/godwit-eyes/session/looker.hpp"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <cstdlib>
#include <iterator>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "io/eyes/codec.hpp"
#include "programs/godwit-eyes/detection/classifier.hpp"
#include "programs/godwit-eyes/detection/detector.hpp"

namespace godwit::eyes {

namespace {

// A camera that is set for one size may send another one of the same shape.
constexpr double same_shape = 0.01;

std::optional<camera_parameters> parameters_of(const io::eyes::begin& wanted, std::int32_t width, std::int32_t height) {
  if (wanted.width_px == 0 || wanted.height_px == 0)
    return std::nullopt;
  const double scale = static_cast<double>(width) / wanted.width_px;
  if (std::abs(scale * wanted.height_px / height - 1) > same_shape)
    return std::nullopt;
  camera_parameters result;
  result.width = width;
  result.height = height;
  result.focal_px = wanted.focal_px * scale;
  result.centre_x_px = (width - 1) / 2.0;
  result.centre_y_px = (height - 1) / 2.0;
  result.k1 = wanted.k1;
  result.k2 = wanted.k2;
  return result;
}

detector_settings settings_for(const io::eyes::begin& wanted, std::int32_t width, std::int32_t height) {
  detector_settings result;
  result.camera = parameters_of(wanted, width, height);
  result.min_height_m = wanted.min_height_m;
  result.max_off_nadir_deg = wanted.max_off_nadir_deg;
  return result;
}

io::eyes::candidate message_of(const candidate& seen) {
  io::eyes::candidate result;
  result.track = seen.track;
  result.where = {seen.box.x_px, seen.box.y_px, seen.box.width_px, seen.box.height_px};
  result.confidence = std::clamp(seen.confidence, 0.0, 1.0);
  result.speed_px_s = seen.speed_px_s;
  result.frames_seen = seen.frames_seen;
  result.looks_like = seen.looks_like;
  if (seen.place)
    result.place =
        io::eyes::ground_place{seen.place->latitude_deg,     seen.place->longitude_deg, seen.place->variance_north_m2,
                               seen.place->variance_east_m2, seen.place->covariance_m2, seen.place->size_m};
  return result;
}

} // namespace

struct looker::parts {
  io::eyes::begin wanted;
  std::function<std::optional<io::video::frame>()> take;
  std::function<void(const io::video::frame&)> pass_on;
  teller tell;

  mutable std::mutex mutex;
  std::condition_variable changed;
  bool is_awake = false;
  bool is_ending = false;
  pose_history poses;
  look_report now;
  std::thread thread;

  // Of the thread.
  model wanted_model;
  std::shared_ptr<classifier> asked;
  std::unique_ptr<detector> seeing;
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::string no_detector; // why there is none for this size

  // Here, where the process is confined: a file that was made to break the parser breaks the helper alone.
  void load_model() {
    if (!wanted_model)
      return;
    auto made = wanted_model->and_then(classifier::make);
    wanted_model.reset();
    if (made)
      asked = *std::move(made);
    const std::lock_guard guard(mutex);
    now.model_error = made ? "" : "the model is not used: " + made.error();
  }

  void run() {
    use_one_thread();
    load_model();
    for (;;) {
      {
        std::unique_lock lock(mutex);
        changed.wait(lock, [this] { return is_awake || is_ending; });
        if (is_ending)
          return;
        is_awake = false;
      }
      if (const auto picture = take()) {
        pass_on(*picture);
        look(*picture);
      }
    }
  }

  void fit(const io::video::frame& picture) {
    if (picture.width == width && picture.height == height)
      return;
    width = picture.width;
    height = picture.height;
    const auto wished = settings_for(wanted, width, height);
    seeing.reset();
    no_detector = problem_of(wished).value_or(std::string());
    if (no_detector.empty())
      seeing = std::make_unique<detector>(wished, asked);
  }

  void look(const io::video::frame& picture) {
    fit(picture);
    std::optional<camera_pose> pose;
    {
      const std::lock_guard guard(mutex);
      pose = poses.at(picture.captured_ns);
    }
    verdict found;
    if (seeing)
      found = seeing->look(view_of(picture, picture.captured_ns), pose);
    if (found.why == unusable::none && !found.confirmed.empty())
      tell_of(picture, found);
    const std::lock_guard guard(mutex);
    ++now.looked;
    now.look_ms = static_cast<double>(found.figures.microseconds) / 1000;
    now.unusable = seeing ? std::string(found.why == unusable::none ? "" : sentence_of(found.why)) : no_detector;
    if (!now.unusable.empty())
      return;
    ++now.usable;
    now.usable_at_ns = picture.captured_ns;
  }

  // Those that were seen in this picture; what only should be there by its motion is no sighting.
  void tell_of(const io::video::frame& picture, const verdict& found) const {
    io::eyes::candidates said;
    said.captured_ns = picture.captured_ns;
    for (const auto& each : found.confirmed) {
      auto candidate = message_of(each);
      if (!each.is_seen_now || said.seen.size() >= io::eyes::max_candidates)
        continue;
      said.seen.push_back(std::move(candidate));
    }
    if (!said.seen.empty() && io::eyes::problem_of(said).empty())
      tell(said, picture);
  }
};

looker::looker(io::eyes::begin wanted, model asked, std::function<std::optional<io::video::frame>()> take,
               std::function<void(const io::video::frame&)> pass_on, teller tell)
    : parts_(std::make_unique<parts>()) {
  parts_->wanted = std::move(wanted);
  parts_->wanted_model = std::move(asked);
  parts_->take = std::move(take);
  parts_->pass_on = std::move(pass_on);
  parts_->tell = std::move(tell);
  parts_->thread = std::thread([all = parts_.get()] { all->run(); });
}

looker::~looker() { end(); }

void looker::end() {
  {
    const std::lock_guard guard(parts_->mutex);
    parts_->is_ending = true;
  }
  parts_->changed.notify_all();
  if (parts_->thread.joinable())
    parts_->thread.join();
}

void looker::wake() {
  {
    const std::lock_guard guard(parts_->mutex);
    parts_->is_awake = true;
  }
  parts_->changed.notify_all();
}

void looker::add(const io::eyes::pose& said) {
  const std::lock_guard guard(parts_->mutex);
  parts_->poses.add(said);
}

look_report looker::report() const {
  const std::lock_guard guard(parts_->mutex);
  return parts_->now;
}

void pose_history::add(const io::eyes::pose& said) {
  if (!poses_.empty() && said.at_ns <= poses_.back().at_ns)
    return;
  camera_pose result;
  result.at_ns = said.at_ns;
  result.attitude = {said.w, said.x, said.y, said.z};
  result.rate = {said.rate_x_rad_s, said.rate_y_rad_s, said.rate_z_rad_s};
  result.latitude_deg = said.latitude_deg;
  result.longitude_deg = said.longitude_deg;
  result.height_m = said.height_m;
  result.attitude_sd_rad = said.attitude_sd_rad;
  result.position_sd_m = said.position_sd_m;
  result.height_sd_m = said.height_sd_m;
  poses_.push_back(result);
  if (poses_.size() > max_poses)
    poses_.pop_front();
}

std::optional<camera_pose> pose_history::at(std::int64_t time_ns) const {
  const auto later = std::ranges::lower_bound(poses_, time_ns, {}, &camera_pose::at_ns);
  const camera_pose* nearest = later == poses_.end() ? nullptr : &*later;
  if (later != poses_.begin()) {
    const auto& earlier = *std::prev(later);
    if (nearest == nullptr || time_ns - earlier.at_ns <= nearest->at_ns - time_ns)
      nearest = &earlier;
  }
  if (nearest == nullptr || std::abs(time_ns - nearest->at_ns) > max_age_ns)
    return std::nullopt;
  return *nearest;
}

} // namespace godwit::eyes
