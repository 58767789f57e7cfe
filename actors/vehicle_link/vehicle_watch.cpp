#include "actors/vehicle_link/vehicle_watch.hpp"

#include <utility>

#include "io/mavlink/enums.hpp"
#include "io/time_units.hpp"

namespace godwit::vehicle_link {

namespace {

constexpr auto wrap_guard_ms = std::uint32_t{1} << 31U; // the 32-bit clock wraps after 49.7 days, which is no restart

} // namespace

std::optional<connection_changed> vehicle_watch::enter(connection_phase phase, std::string reason) {
  reason_ = std::move(reason);
  if (std::exchange(phase_, phase) == phase)
    return std::nullopt;
  return connection_changed{phase_, reason_};
}

std::optional<connection_changed> vehicle_watch::on_transport(bool up, const std::string& reason) {
  if (!up) {
    if (vehicle_)
      vehicle_->peer = io::link::every_peer; // it may come back under another address
    return enter(connection_phase::down, reason);
  }
  if (phase_ != connection_phase::down)
    return std::nullopt;
  return enter(connection_phase::silent, "no heartbeat of an autopilot yet");
}

bool vehicle_watch::is_autopilot(const io::mavlink::heartbeat& beat, std::uint8_t component) const {
  return component == settings_.component &&
         beat.autopilot != static_cast<std::uint8_t>(io::mavlink::mav_autopilot::invalid) &&
         beat.type != static_cast<std::uint8_t>(io::mavlink::mav_type::gcs);
}

// Who is not the vehicle yet, and could be. A vehicle that speaks keeps its place.
bool vehicle_watch::may_begin(std::uint8_t system, io::link::peer_id peer, std::int64_t now_ns) {
  const bool is_kept = vehicle_ && heartbeats_ >= kept_after;
  const bool is_silent = phase_ != connection_phase::connected;
  const auto wanted = settings_.system != 0 ? settings_.system : is_kept ? vehicle_->system : std::uint8_t{0};
  if ((wanted != 0 && wanted != system) || (vehicle_ && !is_silent)) {
    ++other_autopilots_;
    return false;
  }
  return candidates_.note((std::uint64_t{peer} << 8U) | system, settings_.heartbeats_to_begin, now_ns);
}

std::optional<connection_changed> vehicle_watch::on_heartbeat(const io::mavlink::heartbeat& beat, std::uint8_t system,
                                                              std::uint8_t component, std::int64_t now_ns,
                                                              io::link::peer_id peer) {
  if (!is_autopilot(beat, component))
    return std::nullopt;
  if (!is_vehicle(system, component, peer)) {
    if (!may_begin(system, peer, now_ns))
      return std::nullopt;
    if (!has_its_name(system, component))
      heartbeats_ = 0;
    candidates_.clear();
  }
  vehicle_ = known_vehicle{system, component, peer, beat.autopilot, beat.type};
  ++heartbeats_;
  last_heartbeat_ns_ = now_ns;
  return enter(connection_phase::connected, {});
}

std::optional<connection_changed> vehicle_watch::on_refused(const std::string& why) {
  if (phase_ == connection_phase::connected || phase_ == connection_phase::down || reason_ == why)
    return std::nullopt;
  reason_ = why;
  return connection_changed{phase_, reason_};
}

std::optional<connection_changed> vehicle_watch::on_time(std::int64_t now_ns) {
  const auto deadline = next_deadline_ns();
  if (!deadline || now_ns < *deadline)
    return std::nullopt;
  return enter(connection_phase::lost, "no heartbeat of the autopilot for " +
                                           std::to_string(settings_.lost_after_ms / 1000) +
                                           " s; is it powered, and is the line or radio up?");
}

std::optional<vehicle_restarted> vehicle_watch::on_boot_time(std::uint32_t boot_ms, std::int64_t now_ns) {
  const auto before = boot_ms_;
  const bool is_wrapped = before && boot_ms < *before && *before - boot_ms >= wrap_guard_ms;
  if (!before || boot_ms >= *before || is_wrapped) {
    boot_ms_ = boot_ms;
    maybe_.reset();
    return std::nullopt;
  }
  if (*before - boot_ms <= boot_time_tolerance_ms) { // late; the newest time stays the mark
    maybe_.reset();
    return std::nullopt;
  }
  if (!maybe_ || boot_ms < maybe_->newest_ms)
    maybe_ = new_clock{boot_ms, 1, now_ns};
  else if (boot_ms > maybe_->newest_ms) {
    maybe_->newest_ms = boot_ms;
    ++maybe_->frames;
  }
  if (maybe_->frames < frames_of_new_clock || now_ns - maybe_->since_ns < new_clock_ns)
    return std::nullopt;
  boot_ms_ = boot_ms;
  maybe_.reset();
  ++restarts_;
  return vehicle_restarted{*before, boot_ms};
}

std::int64_t vehicle_watch::number_of(std::uint8_t sequence, std::int64_t now_ns) {
  constexpr std::int64_t wrap = 256;
  constexpr std::uint8_t half = 128;
  const auto ahead = static_cast<std::uint8_t>(sequence - static_cast<std::uint8_t>(newest_number_));
  const bool may_be_late = newest_ns_ && now_ns - *newest_ns_ < late_within_ns;
  if (may_be_late && (ahead == 0 || ahead >= half))
    return newest_number_ - (ahead == 0 ? 0 : wrap - ahead);
  newest_number_ += ahead == 0 ? wrap : ahead;
  newest_ns_ = now_ns;
  return newest_number_;
}

std::int64_t vehicle_watch::heartbeat_age_ms(std::int64_t now_ns) const {
  return last_heartbeat_ns_ ? (now_ns - *last_heartbeat_ns_) / ns_per_ms : -1;
}

std::optional<std::int64_t> vehicle_watch::next_deadline_ns() const {
  if (phase_ != connection_phase::connected || !last_heartbeat_ns_)
    return std::nullopt;
  return *last_heartbeat_ns_ + settings_.lost_after_ms * ns_per_ms;
}

} // namespace godwit::vehicle_link
