#include "programs/godwit-drill/flight_simulation/simulated_eyes.hpp"

#include <utility>

#include "actors/domain/geo/geodesic.hpp"

namespace godwit::drill {
namespace {

constexpr std::int64_t beat_ns = 100'000'000;
constexpr int beats_a_status = 5;

} // namespace

void simulated_eyes::start(std::uint32_t run, const io::eyes::begin&) {
  run_ = run;
  ++faults_.starts;
  is_starting_ = true;
  beats_ = 0;
  pose_.reset();
  gone_.clear();
  next_ns_ = 0;
}

void simulated_eyes::end(std::uint32_t upto) {
  if (!run_ || *run_ > upto)
    return;
  run_.reset();
  next_ns_ = never_ns;
}

std::vector<simulated_eyes::news> simulated_eyes::on_time(std::int64_t now_ns) {
  std::vector<news> result;
  if (!run_ || now_ns < next_ns_)
    return result;
  if (std::exchange(is_starting_, false)) {
    next_ns_ = now_ns + start_takes_ns;
    return result;
  }
  next_ns_ = now_ns + beat_ns;
  if (!gone_.empty()) {
    result.emplace_back(movement_detector::helper_ended{*run_, std::exchange(gone_, {})});
    run_.reset();
    next_ns_ = never_ns;
    return result;
  }
  if (faults_.hangs)
    return result;
  if (beats_++ % beats_a_status == 0)
    result.emplace_back(status(now_ns));
  if (auto seen = candidates(now_ns); !seen.what.seen.empty())
    result.emplace_back(std::move(seen));
  return result;
}

movement_detector::helper_status simulated_eyes::status(std::int64_t now_ns) const {
  movement_detector::helper_status result{*run_, {}};
  auto& is = result.what;
  is.at_ns = now_ns;
  if (faults_.has_no_camera) {
    is.source = io::eyes::source_state::failed;
    is.reason = "there is no /dev/video0: connect the camera";
    return result;
  }
  is.source = io::eyes::source_state::playing;
  is.width_px = 640;
  is.height_px = 360;
  is.frames_per_s = 10;
  if (faults_.shows_black) {
    is.fault = io::eyes::picture_fault::black;
    is.unusable = "the picture is dark";
    return result;
  }
  is.usable_at_ns = now_ns;
  return result;
}

movement_detector::helper_candidates simulated_eyes::candidates(std::int64_t now_ns) const {
  movement_detector::helper_candidates result{*run_, {}};
  result.what.captured_ns = now_ns;
  if (!pose_ || faults_.has_no_camera || faults_.shows_black)
    return result;
  for (const auto& each : faults_.movers) {
    if (geo::distance_m(geo::point{pose_->latitude_deg, pose_->longitude_deg},
                        geo::point{each.latitude_deg, each.longitude_deg}) > reach_m)
      continue;
    io::eyes::candidate seen;
    seen.track = each.track;
    seen.confidence = 0.9;
    seen.place = io::eyes::ground_place{each.latitude_deg, each.longitude_deg, 4, 4, 0, 2};
    result.what.seen.push_back(seen);
  }
  return result;
}

} // namespace godwit::drill
