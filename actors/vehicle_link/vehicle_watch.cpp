#include "actors/vehicle_link/vehicle_watch.hpp"

#include <algorithm>
#include <utility>

#include "actors/domain/control_authority/control_authority.hpp"
#include "io/mavlink/enums.hpp"
#include "io/time_units.hpp"

namespace godwit::vehicle_link {

namespace {

std::string name_of(const vehicle_name& who) {
  return "system " + std::to_string(who.system) +
         (who.component == 1 ? std::string() : ", component " + std::to_string(who.component));
}

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
  return enter(connection_phase::silent, why_silent());
}

std::string vehicle_watch::why_silent() const {
  const auto who = waits_for();
  return who.empty() ? "no heartbeat of an autopilot yet" : who + " is not heard yet";
}

// Empty: a heartbeat changes nothing about why nobody is heard.
std::string vehicle_watch::waits_for() const {
  if (kept_)
    return "the vehicle of the flight that is open (" + name_of(*kept_) + ")";
  if (settings_.system != 0)
    return "the vehicle that is set (vehicle.system " + std::to_string(settings_.system) + ")";
  if (vehicle_ && heartbeats_ >= kept_after)
    return "the vehicle (" + name_of({vehicle_->system, vehicle_->component}) + ")";
  return {};
}

// Who waits for its vehicle is told whom it hears in its place.
std::optional<connection_changed> vehicle_watch::wait_on(std::int64_t now_ns) {
  const auto who = waits_for();
  const auto heard = others(now_ns);
  if (who.empty() || heard.empty() || phase_ == connection_phase::connected || phase_ == connection_phase::down)
    return std::nullopt;
  std::string names;
  for (const auto& each : heard)
    names += (names.empty() ? "" : " and ") + name_of(each);
  auto why = who + " is not heard; " + names + (heard.size() == 1 ? " is" : " are") +
             " heard, and nothing is sent there" +
             (kept_ ? "; if the vehicle does not come back, end the flight (godwitd ctl end-flight)" : "");
  if (why == reason_)
    return std::nullopt;
  reason_ = std::move(why);
  return connection_changed{phase_, reason_};
}

std::optional<connection_changed> vehicle_watch::keep(const std::optional<vehicle_name>& who) {
  kept_ = who;
  if (phase_ != connection_phase::silent)
    return std::nullopt;
  reason_ = why_silent();
  return connection_changed{phase_, reason_};
}

// Who is waited for, and has not been heard often enough to be believed, is none.
void vehicle_watch::note_other(vehicle_name who, std::int64_t now_ns) {
  if (who.system == wanted_system() || has_its_name(who.system, who.component))
    return;
  std::erase_if(others_, [&](const other_autopilot& each) {
    return each.who == who || now_ns - each.heard_ns >= others_count_ns;
  });
  if (others_.size() == max_other_autopilots)
    others_.erase(others_.begin());
  others_.push_back({who, now_ns});
}

std::vector<vehicle_name> vehicle_watch::others(std::int64_t now_ns) const {
  std::vector<vehicle_name> result;
  for (const auto& each : others_)
    if (now_ns - each.heard_ns < others_count_ns && !has_its_name(each.who.system, each.who.component))
      result.push_back(each.who);
  std::ranges::sort(result, {}, [](const vehicle_name& each) { return std::pair(each.system, each.component); });
  return result;
}

bool vehicle_watch::is_autopilot(const io::mavlink::heartbeat& beat, std::uint8_t component) const {
  return component == (kept_ ? kept_->component : settings_.component) &&
         beat.autopilot != static_cast<std::uint8_t>(io::mavlink::mav_autopilot::invalid) &&
         beat.type != static_cast<std::uint8_t>(io::mavlink::mav_type::gcs);
}

std::uint8_t vehicle_watch::wanted_system() const {
  if (kept_)
    return kept_->system;
  if (settings_.system != 0)
    return settings_.system;
  return vehicle_ && heartbeats_ >= kept_after ? vehicle_->system : std::uint8_t{0};
}

// Who is not the vehicle yet, and could be. A vehicle that speaks keeps its place.
bool vehicle_watch::may_begin(std::uint8_t system, io::link::peer_id peer, std::int64_t now_ns) {
  const bool is_silent = phase_ != connection_phase::connected;
  const auto wanted = wanted_system();
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
    if (!may_begin(system, peer, now_ns)) {
      note_other({system, component}, now_ns);
      return wait_on(now_ns);
    }
    if (!has_its_name(system, component)) {
      heartbeats_ = 0;
      was_up_ = false;
      boot_ms_.reset(); // it has a clock and numbers of its own
      maybe_.reset();
      newest_ns_.reset();
    }
    candidates_.clear();
  }
  vehicle_ = known_vehicle{system, component, peer, beat.autopilot, beat.type};
  ++heartbeats_;
  if (heartbeats_ == 1 || heard_for_ms(now_ns) < 0)
    heard_since_ns_ = now_ns;
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

std::optional<vehicle_restarted> vehicle_watch::on_state(const io::mavlink::heartbeat& beat) {
  const bool boots = beat.system_status == io::mavlink::number(io::mavlink::mav_state::uninit) ||
                     beat.system_status == io::mavlink::number(io::mavlink::mav_state::boot);
  const bool was_up = std::exchange(was_up_, !boots);
  if (!was_up || !boots || io::mavlink::is_armed(beat))
    return std::nullopt;
  const auto before = std::exchange(boot_ms_, std::nullopt); // what comes next is of the new clock
  maybe_.reset();
  ++restarts_;
  return vehicle_restarted{before.value_or(0), 0};
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

std::int64_t vehicle_watch::heard_for_ms(std::int64_t now_ns) const {
  const bool is_silent = !last_heartbeat_ns_ || now_ns - *last_heartbeat_ns_ > flight::silence_ns;
  return is_silent ? -1 : (now_ns - heard_since_ns_) / ns_per_ms;
}

std::optional<std::int64_t> vehicle_watch::next_deadline_ns() const {
  if (phase_ != connection_phase::connected || !last_heartbeat_ns_)
    return std::nullopt;
  return *last_heartbeat_ns_ + settings_.lost_after_ms * ns_per_ms;
}

} // namespace godwit::vehicle_link
