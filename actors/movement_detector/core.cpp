#include "actors/movement_detector/core.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "actors/domain/uuid/uuid.hpp"
#include "actors/movement_detector/camera_attitude.hpp"
#include "io/mavlink/frame_meaning.hpp"

namespace godwit::movement_detector {
namespace {

constexpr double rad_in_deg = std::numbers::pi / 180;
using io::mavlink::units_a_degree;
constexpr double mm_in_m = 1000;
constexpr double position_sd_m = 3; // of a satellite receiver, with the time that a message needs
constexpr double height_sd_m = 5;   // the ground is taken to be as high as home
constexpr std::int64_t ns_in_s = 1'000'000'000;
constexpr std::uint64_t seen_by_eyes = 0x65796573; // keeps these ids apart from what else follows from a mission

io::eyes::begin beginning_of(const settings& configured) {
  io::eyes::begin result;
  result.uri = configured.uri;
  result.width_px = configured.width_px;
  result.height_px = configured.height_px;
  result.focal_px = configured.focal_px;
  result.k1 = configured.k1;
  result.k2 = configured.k2;
  result.min_height_m = configured.min_height_m;
  result.max_off_nadir_deg = configured.max_off_nadir_deg;
  result.record_folder = configured.record_folder;
  result.record_max_mb = configured.record_max_mb;
  result.model = configured.model;
  return result;
}

} // namespace

core::core(settings configured, std::uint64_t seed, std::uint64_t incarnation)
    : settings_(std::move(configured)), seed_(seed),
      mount_(settings_.is_on_gimbal
                 ? mount_of(0, 0, 0)
                 : mount_of(settings_.mount_roll_deg * rad_in_deg, settings_.mount_pitch_deg * rad_in_deg,
                            settings_.mount_yaw_deg * rad_in_deg)),
      run_(static_cast<std::uint32_t>(incarnation) * runs_of_incarnation) {}

effects core::start(instant now) {
  state_ = helper_state::starting;
  ++run_;
  ++starts_;
  started_ns_ = now.monotonic_ns;
  due_ns_ = now.monotonic_ns + first_word_ns;
  status_.reset();
  told_.clear(); // tracks of another run have the same numbers
  return {start_helper{run_, beginning_of(settings_)}};
}

// IS_RUNNING: it has to be ended first.
effects core::rest(const std::string& why, bool is_running, instant now) {
  if (now.monotonic_ns - started_ns_ > sound_after_ns)
    wait_ns_ = first_wait_ns;
  state_ = helper_state::resting;
  due_ns_ = now.monotonic_ns + wait_ns_;
  wait_ns_ = std::min(longest_wait_ns, wait_ns_ * 2);
  gone_ = why;
  status_.reset();
  effects result;
  if (is_running)
    result.emplace_back(end_helper{run_});
  result.emplace_back(announce{"godwit-eyes is started again: " + why, true});
  return result;
}

effects core::on_attitude(const io::mavlink::attitude& m, instant now) {
  if (settings_.is_on_gimbal) {
    vehicle_ = {m, now.monotonic_ns};
    return {};
  }
  attitude_ns_ = now.monotonic_ns;
  return pose_of(from_angles(m.roll, m.pitch, m.yaw) * mount_,
                 turned(inverse(mount_), {m.rollspeed, m.pitchspeed, m.yawspeed}), now);
}

effects core::on_gimbal(const io::mavlink::gimbal_device_attitude_status& m, instant now) {
  if (!settings_.is_on_gimbal)
    return {};
  const auto lies = attitude_of(m, heading(now));
  if (!lies)
    return {};
  attitude_ns_ = now.monotonic_ns;
  const gimbal_told newest{*lies * mount_, now.monotonic_ns};
  const auto before = std::exchange(gimbal_, newest);
  if (!before || newest.at_ns <= before->at_ns || newest.at_ns - before->at_ns > gimbal_gap_ns)
    return {};
  const double dt_s = static_cast<double>(newest.at_ns - before->at_ns) / ns_in_s;
  return pose_of(newest.camera, rate_between(before->camera, newest.camera, dt_s), now);
}

// Of the vehicle, now.
std::optional<double> core::heading(instant now) const {
  if (!vehicle_ || now.monotonic_ns - vehicle_->at_ns > heading_lasts_ns)
    return std::nullopt;
  const double age_s = static_cast<double>(now.monotonic_ns - vehicle_->at_ns) / ns_in_s;
  return vehicle_->what.yaw + vehicle_->what.yawspeed * age_s;
}

effects core::pose_of(const rotation& camera, const std::array<double, 3>& rate, instant now) const {
  if (state_ != helper_state::running || !position_ || now.monotonic_ns - position_ns_ > telemetry_lasts_ns)
    return {};
  io::eyes::pose result;
  result.at_ns = now.monotonic_ns;
  result.w = camera.w;
  result.x = camera.x;
  result.y = camera.y;
  result.z = camera.z;
  result.rate_x_rad_s = rate[0];
  result.rate_y_rad_s = rate[1];
  result.rate_z_rad_s = rate[2];
  result.latitude_deg = position_->lat / units_a_degree;
  result.longitude_deg = position_->lon / units_a_degree;
  result.height_m = position_->relative_alt / mm_in_m;
  result.attitude_sd_rad = settings_.attitude_sd_deg * rad_in_deg;
  result.position_sd_m = position_sd_m;
  result.height_sd_m = height_sd_m;
  const bool is_sound = std::isfinite(camera.w + camera.x + camera.y + camera.z + rate[0] + rate[1] + rate[2]);
  return is_sound ? effects{result} : effects{};
}

void core::on_position(const io::mavlink::global_position_int& m, instant now) {
  constexpr double most_latitude = 90;
  constexpr double most_longitude = 180;
  if (std::abs(m.lat / units_a_degree) > most_latitude || std::abs(m.lon / units_a_degree) > most_longitude)
    return;
  position_ = m;
  position_ns_ = now.monotonic_ns;
}

effects core::on_status(const helper_status& m, instant now) {
  if (m.run != run_ || state_ == helper_state::resting)
    return {};
  state_ = helper_state::running;
  due_ns_ = now.monotonic_ns + silence_ns;
  status_ = m.what;
  const bool is_of_use = status_->unusable.empty() && status_->fault == io::eyes::picture_fault::none;
  if (is_of_use || status_->source != io::eyes::source_state::playing)
    sound_ns_ = now.monotonic_ns;
  if (status_->source == io::eyes::source_state::playing)
    gone_.clear();
  return {};
}

effects core::on_ended(const helper_ended& m, instant now) {
  if (m.run != run_ || state_ == helper_state::resting)
    return {};
  return rest(m.why, false, now);
}

effects core::on_time(instant now) {
  effects result;
  if (now.monotonic_ns >= due_ns_) {
    if (state_ == helper_state::resting)
      result = start(now);
    else
      result = rest(state_ == helper_state::starting ? "it has sent nothing since it was started"
                                                     : "it has sent nothing for 2 s",
                    true, now);
  }
  if (now.monotonic_ns >= next_view_ns_) {
    next_view_ns_ = now.monotonic_ns + view_period_ns;
    result.emplace_back(scan_controller::view{is_seeing(now), sentence(now)});
  }
  return result;
}

std::int64_t core::next_due_ns() const { return std::min(due_ns_, next_view_ns_); }

// Whether what moved there of late would have been found, and could be told where.
bool core::is_seeing(instant now) const {
  return state_ == helper_state::running && status_ && status_->usable_at_ns != 0 &&
         now.monotonic_ns - status_->usable_at_ns <= view_lasts_ns &&
         now.monotonic_ns - attitude_ns_ <= telemetry_lasts_ns && now.monotonic_ns - position_ns_ <= telemetry_lasts_ns;
}

std::string core::sentence(instant now) const {
  if (state_ != helper_state::running)
    return gone_.empty() ? "godwit-eyes is starting" : "godwit-eyes is started again: " + gone_;
  if (auto pictures = sentence_of_pictures(now); !pictures.empty())
    return pictures;
  if (now.monotonic_ns - attitude_ns_ > telemetry_lasts_ns || now.monotonic_ns - position_ns_ > telemetry_lasts_ns)
    return std::string(settings_.is_on_gimbal ? "the gimbal reports no attitude that can be used"
                                              : "the vehicle reports no attitude") +
           ", or the vehicle no position: what moves is found, and not where it is";
  return status_->model_error;
}

std::string core::sentence_of_pictures(instant now) const {
  const auto& is = *status_;
  if (is.source != io::eyes::source_state::playing)
    return is.reason.empty() ? "the camera is being opened" : is.reason;
  if (is.fault == io::eyes::picture_fault::black)
    return "the camera sends black pictures: look whether its lens is covered, and at its exposure";
  if (is.fault == io::eyes::picture_fault::repeated)
    return "the camera sends the same picture again and again: switch it off and on";
  if (!is.unusable.empty() && now.monotonic_ns - sound_ns_ > unusable_told_ns)
    return "the pictures are of no use: " + is.unusable;
  return {};
}

effects core::on_candidates(const helper_candidates& m, instant now) {
  if (m.run != run_ || state_ == helper_state::resting || m.what.captured_ns > now.monotonic_ns ||
      now.monotonic_ns - m.what.captured_ns > view_lasts_ns)
    return {};
  effects result;
  candidates_ += m.what.seen.size();
  for (const auto& each : m.what.seen)
    if (auto seen = sighting_of(each, m.what.captured_ns, now)) {
      result.emplace_back(keep_picture{each.track, m.what.captured_ns, seen->id});
      result.emplace_back(*std::move(seen));
    }
  return result;
}

// Only of a survey that is flown: before it, and when somebody else has the vehicle, nobody looks for anything.
std::optional<mapobjects_store::sighting> core::sighting_of(const io::eyes::candidate& seen, std::int64_t captured_ns,
                                                            instant now) {
  if (!seen.place) {
    ++without_place_;
    return std::nullopt;
  }
  if (!survey_ || !survey_->is_flying || survey_->item_id.empty() || seen.confidence < settings_.min_confidence ||
      !has_room_for(seen, now))
    return std::nullopt;
  ++sightings_;
  mapobjects_store::sighting result;
  result.mission_id = survey_->mission_id;
  result.id = ids::derived_uuid(ids::derived_uuid(result.mission_id, ids::text_of({seen_by_eyes, seed_})),
                                ids::text_of({(std::uint64_t{run_} << 32U) | seen.track, sightings_}));
  result.class_group = told_.at(seen.track).class_group;
  result.position = {seen.place->latitude_deg, seen.place->longitude_deg, std::nullopt};
  result.at_ns = now.wall_ns - (now.monotonic_ns - captured_ns);
  result.confidence = seen.confidence;
  return result;
}

// One that was said before goes on under the same class group: on the map it would be a second thing otherwise.
bool core::has_room_for(const io::eyes::candidate& seen, instant now) {
  if (now.monotonic_ns - second_ns_ >= ns_in_s) {
    second_ns_ = now.monotonic_ns;
    in_second_ = 0;
  }
  const auto told = told_.find(seen.track);
  if (in_second_ >= max_sightings_a_second ||
      (told != told_.end() && now.monotonic_ns - told->second.at_ns < same_track_ns))
    return false;
  if (told != told_.end()) {
    told->second.at_ns = now.monotonic_ns;
  } else {
    if (told_.size() >= max_tracks)
      told_.erase(told_.begin()); // the oldest: numbers of tracks rise
    const bool is_known = seen.looks_like != io::eyes::object_class::unknown;
    told_[seen.track] = {now.monotonic_ns,
                         is_known ? std::string(io::name_of(seen.looks_like)) : settings_.class_group};
  }
  ++in_second_;
  return true;
}

runtime::condition core::health(instant now) const {
  auto why = sentence(now);
  const bool is_starting = state_ != helper_state::running && gone_.empty();
  if (why.empty() || is_starting)
    return {runtime::health_colour::green, {}};
  return {runtime::health_colour::yellow, std::move(why)};
}

eyes_view core::view_of(instant now) const {
  eyes_view result;
  result.is_seeing = is_seeing(now);
  result.sentence = sentence(now);
  result.starts = starts_;
  result.candidates = candidates_;
  result.sightings = sightings_;
  result.without_place = without_place_;
  if (!status_)
    return result;
  result.width_px = status_->width_px;
  result.height_px = status_->height_px;
  result.frames_per_s = status_->frames_per_s;
  result.frames = status_->frames;
  result.dropped = status_->dropped;
  result.looked = status_->looked;
  result.usable = status_->usable;
  result.recorded_kb = status_->recorded_kb;
  result.look_ms = status_->look_ms;
  return result;
}

} // namespace godwit::movement_detector
