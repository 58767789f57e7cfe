#include "actors/executor/view.hpp"

#include <algorithm>
#include <cmath>

#include "actors/domain/control_authority/control_authority.hpp"
#include "actors/domain/control_authority/mode_tables.hpp"
#include "actors/domain/geo/geodesic.hpp"
#include "actors/domain/vehicle_text/vehicle_text.hpp"
#include "actors/executor/preflight/checks.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame_meaning.hpp"
#include "io/mavlink/messages/heartbeat.hpp"

namespace godwit::executor {
namespace {

using io::mavlink::mav_landed_state;

using io::mavlink::units_a_degree;
constexpr double metres_of_mm = 1e-3;
constexpr double metres_of_cm = 1e-2;
constexpr std::uint8_t satellites_unknown = 255;

// Without a landing detector's word, so much above home is off the ground.
constexpr double off_the_ground_m = 1;

// In a longer silence somebody may disarm the vehicle and arm it again. Five heartbeats a second come in a start, and
// one afterwards.
constexpr std::int64_t gap_ns = 1'250'000'000;

// Where a rover stops that was told to return.
constexpr double at_home_m = 8;

} // namespace

// An ArduPlane that takes off vertically calls itself an aeroplane unless it is told otherwise: both are known as the
// one that executes more.
std::optional<mission::vehicle_profile> vehicle_view::profile() const {
  using enum mission::vehicle_profile;
  using flight::vehicle_class;
  const bool is_px4 = owner_.autopilot == io::mavlink::mav_autopilot::px4;
  if (!is_px4 && owner_.autopilot != io::mavlink::mav_autopilot::ardupilotmega)
    return std::nullopt;
  switch (owner_.vehicle) {
  case vehicle_class::multirotor:
    return is_px4 ? px4_multicopter : arducopter;
  case vehicle_class::fixed_wing:
    return is_px4 ? (is_plain_wing_ ? px4_fixed_wing : px4_vtol) : quadplane;
  case vehicle_class::rover:
    return is_px4 ? px4_rover : ardurover;
  case vehicle_class::unknown:
    break;
  }
  return std::nullopt;
}

void vehicle_view::take(const vehicle_link::connection_changed& m) {
  phase_ = m.phase;
  reason_ = m.reason;
  if (!is_connected()) { // what it does meanwhile is not known
    mode_.reset();
    is_ground_told_ = false;
  }
}

void vehicle_view::take(const io::mavlink::heartbeat& m, std::int64_t now_ns) {
  if (!mode_)
    heard_since_ns_ = now_ns;
  owner_ = flight::owner_of(m);
  is_plain_wing_ = m.type == io::mavlink::number(io::mavlink::mav_type::fixed_wing);
  mode_ = flight::mode_of(m);
  is_armed_ = io::mavlink::is_armed(m);
  is_critical_ = m.system_status == io::mavlink::number(io::mavlink::mav_state::critical);
  ++heartbeats_;
  if (heartbeat_ns_ != 0 && now_ns - heartbeat_ns_ > gap_ns)
    unbroken_since_ns_ = now_ns;
  heartbeat_ns_ = now_ns;
}

void vehicle_view::take(const io::mavlink::current_mode& m) {
  if (mode_)
    mode_ = flight::mode_of(owner_, m.custom_mode);
}

void vehicle_view::take(const io::mavlink::sys_status& m) {
  battery_percent_ = m.battery_remaining;
  own_checks_ = preflight::own_checks_of(m, owner_.autopilot);
}

void vehicle_view::take(const io::mavlink::gps_raw_int& m) {
  fix_type_ = m.fix_type;
  satellites_ = m.satellites_visible == satellites_unknown ? -1 : m.satellites_visible;
}

void vehicle_view::take(const io::mavlink::global_position_int& m, std::int64_t now_ns) {
  place_ = mission::position{m.lat / units_a_degree, m.lon / units_a_degree, m.relative_alt * metres_of_mm};
  speed_mps_ = std::hypot(m.vx * metres_of_cm, m.vy * metres_of_cm);
  place_heard_ns_ = now_ns;
}

void vehicle_view::take(const io::mavlink::home_position& m, std::int64_t now_ns) {
  home_heard_ns_ = now_ns;
  home_ = plan::vehicle_home{m.latitude / units_a_degree, m.longitude / units_a_degree, m.altitude * metres_of_mm, 0};
}

void vehicle_view::take(const io::mavlink::extended_sys_state& m) {
  landed_ = static_cast<mav_landed_state>(m.landed_state);
  is_ground_told_ = true;
}

void vehicle_view::take(const io::mavlink::mission_current& m, std::int64_t now_ns) {
  current_ = m;
  current_heard_ns_ = now_ns;
}

void vehicle_view::take_estimate(std::uint16_t flags, std::int64_t now_ns) {
  estimate_ = {preflight::estimate_of(flags), now_ns};
}

void vehicle_view::take(const flight::vehicle_message& m, std::int64_t now_ns) {
  if (flight::tells_why_not_armed(m.text))
    why_not_armed_ = {m.text, now_ns};
  if (m.severity <= io::mavlink::number(io::mavlink::mav_severity::warning) && !m.text.empty())
    warned_ = {m.text.substr(0, m.text.find_last_not_of(" \t") + 1), now_ns}; // PX4's end with a tab
}

std::string vehicle_view::warned_since(std::int64_t ns) const {
  return warned_ && warned_->at_ns >= ns ? warned_->what : std::string();
}

preflight::estimate vehicle_view::estimate(std::int64_t now_ns) const {
  if (estimate_ && now_ns - estimate_->at_ns <= estimate_counts_ns)
    return estimate_->what;
  const bool may_still_come =
      preflight::tells_estimate(owner_.autopilot) && (!mode_ || now_ns - heard_since_ns_ <= estimate_counts_ns);
  return may_still_come ? preflight::estimate::unknown : preflight::estimate::not_told;
}

std::string vehicle_view::why_not_armed(std::int64_t now_ns) const {
  return why_not_armed_ && now_ns - why_not_armed_->at_ns <= words_count_ns ? why_not_armed_->what : std::string();
}

bool vehicle_view::is_in_one_of(const std::vector<std::uint32_t>& modes) const {
  return mode_ && std::ranges::find(modes, mode_->custom_mode) != modes.end();
}

bool vehicle_view::obeys(flight::mode_kind kind) const { return is_in_one_of(flight::modes_obeying(owner_, kind)); }

bool vehicle_view::says_complete() const { return says(io::mavlink::mission_state::complete); }

bool vehicle_view::says_incomplete() const {
  using io::mavlink::mission_state;
  return says(mission_state::not_started) || says(mission_state::active) || says(mission_state::paused);
}

bool vehicle_view::says(io::mavlink::mission_state what) const {
  return current_ && current_->mission_state == io::mavlink::number(what);
}

bool vehicle_view::finds_infeasible() const {
  constexpr std::uint16_t total_of_no_plan = 65535;
  return current_ && current_->mission_id != 0 && current_->total != 0 && current_->total != total_of_no_plan &&
         current_->mission_state == io::mavlink::number(io::mavlink::mission_state::no_mission);
}

bool vehicle_view::is_within(double metres, const geo::point& there, std::int64_t now_ns) const {
  const auto at = place(now_ns);
  if (!at)
    return false;
  const geo::point here{at->latitude, at->longitude};
  return geo::is_valid(here) && geo::is_valid(there) && geo::distance_m(here, there) <= metres;
}

bool vehicle_view::stands_at_home(std::int64_t now_ns) const {
  return home_ && stands() && is_within(at_home_m, {home_->latitude, home_->longitude}, now_ns);
}

bool vehicle_view::is_moving() const {
  if (owner_.vehicle != flight::vehicle_class::rover)
    return is_under_way();
  return is_armed_ && (is_in(flight::mode_kind::mission) || speed_mps_ > standing_mps);
}

bool vehicle_view::is_under_way() const {
  if (!is_armed_ || owner_.vehicle == flight::vehicle_class::rover)
    return is_armed_;
  if (landed_ == mav_landed_state::undefined)
    return place_ && place_->altitude_m > off_the_ground_m;
  return landed_ != mav_landed_state::on_ground;
}

bool vehicle_view::is_in_begun_mission() const {
  return is_in(flight::mode_kind::mission) && current_ &&
         current_->mission_state != io::mavlink::number(io::mavlink::mission_state::not_started);
}

bool vehicle_view::is_seen() const { return is_connected() && mode_ && (!is_armed_ || knows_ground()); }

// One without a landing detector is judged by its height.
bool vehicle_view::knows_ground() const {
  const bool has_detector = landed_ != mav_landed_state::undefined;
  return owner_.vehicle == flight::vehicle_class::rover || (has_detector ? is_ground_told_ : place_.has_value());
}

std::optional<mission::position> vehicle_view::place(std::int64_t now_ns) const {
  return place_ && now_ns - place_heard_ns_ <= position_counts_ns ? place_ : std::nullopt;
}

} // namespace godwit::executor
