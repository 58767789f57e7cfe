#include "tests/actors/failsafe/flight_world.hpp"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "actors/domain/flight_mode/flight_modes.hpp"
#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"
#include "runtime/assert.hpp"

namespace godwit::tests {

using namespace failsafe;
using vehicle_link::command_verdict;

namespace {

constexpr std::int64_t command_timeout_ms = 1'000; // of vehicle_link
constexpr std::size_t max_records = 8;             // as far back as a kill can go

mode_kind kind_after(action what) {
  switch (what) {
  case action::return_home:
    return mode_kind::returning;
  case action::land:
    return mode_kind::landing;
  case action::hold:
    return mode_kind::hold;
  case action::do_land_start:
    break;
  }
  return mode_kind::mission;
}

state through_json(const state& from) {
  state result;
  const auto read = io::read_json(nlohmann::json::parse(io::to_json(from)), result);
  GODWIT_ASSERT(read.has_value(), "a state that was written can be read");
  return result;
}

} // namespace

flight_world::flight_world(vehicle_class of, const settings& configured) : type(of), settings_(configured) {
  mode = in(mode_kind::mission);
  core_.emplace(settings_, records_.back(), now());
}

instant flight_world::now() const {
  return {500 * ns_per_s + ms_ * ns_per_ms, 1'700'000'000 * ns_per_s + ms_ * ns_per_ms};
}

flight_mode flight_world::in(mode_kind kind) const {
  return {kind, flight::number_of({io::mavlink::mav_autopilot::generic, type}, kind).value_or(0)};
}

void flight_world::tell(const event& what) { core_->take(what, now()); }

void flight_world::set_fences(const std::vector<mission::geofence>& fences, std::optional<std::uint16_t> land_start,
                              const flight::plan_end& end) {
  tell(asked_guard{1, {fences, land_start, end}});
}

void flight_world::override_for_s(rule scope, std::int64_t s) {
  tell(asked_override{42, {scope, "the operator wants it", now().wall_ns + s * ns_per_s}});
}

void flight_world::speak() {
  if (operator_there)
    heard_ms_ = ms_;
  if (ms_ % 1'000 == 0) {
    if (sends_heartbeats) {
      tell(heartbeat{type, armed, mode});
      tell(failsafe::landed{landed});
      told_in_air = armed && (type == vehicle_class::rover || landed != landed_state::on_ground);
    }
    if (sends_sequence)
      tell(mission_current{sequence, is_complete});
    if (sends_battery)
      tell(battery{battery_percent});
    if (port_alive)
      tell(operator_heard{heard_ms_ >= 0, heard_ms_ >= 0 ? ms_ - heard_ms_ : -1});
  }
  if (sends_positions && ms_ % 200 == 0) {
    auto there = position_at(east_m, north_m, altitude_m, east_mps);
    there.boot_ms = static_cast<std::uint32_t>(ms_);
    tell(there);
  }
}

void flight_world::obey() {
  while (!to_vehicle_.empty() && to_vehicle_.front().at_ms <= ms_) {
    const auto command = to_vehicle_.front().what;
    to_vehicle_.pop_front();
    obeyed.push_back(command);
    mode = in(kind_after(command.what));
    if (command.what == action::do_land_start)
      sequence = landing_sequence;
  }
  while (!to_core_.empty() && to_core_.front().at_ms <= ms_) {
    tell(to_core_.front().what);
    to_core_.pop_front();
  }
}

void flight_world::handle(const command_vehicle& command) {
  sent.push_back(command);
  if (!first_sent_ms)
    first_sent_ms = ms_;
  if (refuses) {
    to_core_.push_back({ms_ + 20, {command.number, *refuses}});
    return;
  }
  if (hears)
    to_vehicle_.push_back({ms_ + obeys_after_ms, command});
  if (hears && answers)
    to_core_.push_back({ms_ + obeys_after_ms + 20, {command.number, command_verdict::accepted}});
  else
    to_core_.push_back({ms_ + command_timeout_ms, {command.number, command_verdict::timed_out}});
}

void flight_world::handle(const failsafe_status_changed& what) {
  const auto last = std::exchange(told_, what.now);
  const auto& before = last.reacts;
  const auto& reacts = what.now.reacts;
  if (reacts && (!before || before->why != reacts->why || before->what != reacts->what))
    acted.push_back(*reacts);
  if (before && what.now.in_flight && (!reacts || is_higher(before->why, reacts->why)))
    lifted.push_back(*before);
  pilots_seen += what.now.taken_over && !last.taken_over ? 1 : 0;
}

void flight_world::handle(const remember& written) {
  ++remembered;
  auto next = records_.back();
  (void)durable_core::apply(next, written.what, now().wall_ns);
  records_.push_back(std::move(next));
  if (records_.size() > max_records)
    records_.erase(records_.begin());
}

void flight_world::take(const effects& wanted) {
  for (const auto& each : wanted)
    std::visit([this](const auto& what) { handle(what); }, each);
}

void flight_world::run_ms(std::int64_t ms) {
  for (const auto end = ms_ + ms; ms_ < end; ms_ += tick_ms) {
    obey();
    speak();
    take(core_->tick(now()));
  }
}

void flight_world::restart() { kill(0); }

void flight_world::kill(std::size_t kept_less) {
  records_.resize(std::max<std::size_t>(records_.size() - std::min(kept_less, records_.size()), 1));
  to_core_.clear(); // answers find nobody who waits for them
  core_.emplace(settings_, through_json(records_.back()), now());
}

bool flight_world::has_warned_of(const std::string& text) const {
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const std::string& each) { return each.find(text) != std::string::npos; });
}

} // namespace godwit::tests
