#include "programs/godwit-sim/vehicle/vehicle_parts.hpp"

#include <algorithm>
#include <vector>

#include "programs/godwit-sim/vehicle/autopilot/copter.hpp"
#include "programs/godwit-sim/vehicle/autopilot/home_item.hpp"
#include "programs/godwit-sim/vehicle/autopilot/plane.hpp"
#include "programs/godwit-sim/vehicle/autopilot/px4.hpp"
#include "programs/godwit-sim/vehicle/autopilot/rover.hpp"
#include "programs/godwit-sim/vehicle/other_aircraft.hpp"
#include "runtime/assert.hpp"

namespace godwit::sim {

namespace {

constexpr std::uint8_t autopilot_component = 1;
constexpr std::uint8_t receiver_component = 156; // MAV_COMP_ID_ADSB

std::unique_ptr<autopilot> make_autopilot(const vehicle_settings& settings, const equipment& with) {
  switch (settings.who) {
  case personality::rover:
    return std::make_unique<rover>(with, settings.arms_on_start);
  case personality::px4:
  case personality::px4_vtol:
    return std::make_unique<px4>(with, settings.holds_when_landed || settings.who == personality::px4_vtol,
                                 settings.has_sticks);
  case personality::ardupilot:
    return std::make_unique<copter>(with);
  case personality::plane:
  case personality::quadplane:
    return std::make_unique<plane>(with, settings.rtl_autoland);
  case personality::ardurover:
    return std::make_unique<ardu_rover>(with);
  }
  GODWIT_ASSERT(false, "each personality has its autopilot");
}

// ArduPilot keeps its home as item 0 of the mission.
plans::server_profile with_home(plans::server_profile server_profile, const position& home) {
  if (server_profile.home)
    server_profile.home = home_item(*server_profile.home, home);
  return server_profile;
}

// A ground station looks for its vehicle's id there, by one of the names that it has had.
std::vector<role::param> with_settings(std::vector<role::param> params, const vehicle_settings& settings) {
  for (auto& each : params)
    if (each.name == "RTL_AUTOLAND")
      each.value = static_cast<float>(settings.rtl_autoland);
    else if (each.name == "SYSID_THISMAV" || each.name == "MAV_SYSID" || each.name == "MAV_SYS_ID")
      each.value = settings.system;
  return params;
}

std::string_view word_for(run_state how) {
  switch (how) {
  case run_state::idle:
    return "idle";
  case run_state::running:
    return "running";
  case run_state::completed:
    return "completed";
  }
  return "";
}

} // namespace

vehicle::parts::parts(const vehicle_settings& settings, std::int64_t now_ns, frame_sink send)
    : settings_(settings), traits_(traits_of(settings.who)), clock_(settings.speed, now_ns), now_(clock_.at(now_ns)),
      random_(settings.seed), out_({settings.system, autopilot_component}, std::move(send), traits_.numbers_each_text),
      craft_(traits_.body, settings.home), power_(settings.battery_percent, settings.endurance_s),
      tells_(traits_, craft_, power_, state_, out_),
      plans_(with_home(traits_.plan_profile, settings.home), out_.ourselves()),
      params_(with_settings(traits_.params, settings), traits_.param_encoding) {
  GODWIT_ASSERT(settings.speed > 0 && settings.stream_factor > 0, "the world and its streams go forward");
  state_.mode = state_.intended = find_mode(traits_.modes, traits_.first_mode);
  state_.is_ready = traits_.ready_after_ns == 0;
  state_.beats_at_mode_change = traits_.beats_at_mode_change && settings.beats_at_mode_change;
  state_.has_estimate = traits_.estimate_after_ns == 0;
  state_.has_payload = settings.has_payload;
  streams_.push_back(make_streams());
  pilot_ = make_autopilot(settings, {traits_, craft_, plans_, out_, tells_, streams_, state_, random_});
  pilot_->set_now(now_);
  find_deadline();
}

line_number vehicle::parts::add_line(frame_sink send, std::int64_t now_ns) {
  advance(now_ns);
  streams_.push_back(make_streams());
  const auto number = out_.add_line(std::move(send));
  end_turn();
  return number;
}

line_streams vehicle::parts::make_streams() {
  std::vector<role::streamed_message> table(traits_.streams.begin(), traits_.streams.end());
  for (auto& each : table)
    if (each.id != mavlink::heartbeat::message_id)
      each.interval_ns = static_cast<std::int64_t>(static_cast<double>(each.interval_ns) / settings_.stream_factor);
  const auto phase = static_cast<double>(random_() >> 11U) * 0x1p-53; // 0 to 1
  return {role::message_schedule(table, now_.world_ns, phase),
          role::current_report(role::current_report::period_ns, traits_.tells_current_on_change)};
}

// -- time -------------------------------------------------------------------------------------------

void vehicle::parts::on_time(std::int64_t now_ns) {
  advance(now_ns);
  end_turn();
}

void vehicle::parts::advance(std::int64_t now_ns) {
  now_ = clock_.at(std::max(now_ns, now_.real_ns));
  pilot_->set_now(now_);
  if (is_starting_ && now_.real_ns >= silent_until_ns_)
    start_up();
  advance_world();
  if (is_starting_)
    return;
  advance_autopilot();
  advance_plans();
  advance_params();
  send_streams();
  send_aircraft();
}

// Once a second of the world each.
void vehicle::parts::send_aircraft() {
  if (settings_.aircraft == 0 || now_.world_ns < next_aircraft_ns_)
    return;
  next_aircraft_ns_ = now_.world_ns + ns_per_s;
  for (int number = 0; number < settings_.aircraft; ++number)
    out_.send_as(receiver_component, other_aircraft(settings_.home, number, static_cast<double>(now_.world_ns) * 1e-9));
}

void vehicle::parts::send_streams() {
  for (line_number number = 0; number < streams_.size(); ++number) {
    const auto there = out_.aim(number);
    streams_[number].messages.for_each_due(now_.world_ns, [this](std::uint32_t id) {
      if (!state_.is_booting || id == mavlink::heartbeat::message_id)
        static_cast<void>(tells_.send(id, now_.world_ns)); // those of the table are known
    });
  }
}

void vehicle::parts::advance_world() {
  power_.advance(now_.world_ns, load());
  const bool is_empty = power_.percent() <= 0;
  const bool flies_on = state_.is_armed && state_.mode->kind != mode_kind::land;
  if (is_empty && (!state_.is_battery_empty || flies_on))
    pilot_->empty_battery();
  state_.is_battery_empty = is_empty;
  for (const auto& each : craft_.advance(now_.world_ns))
    if (!is_starting_)
      pilot_->on_happening(each);
}

void vehicle::parts::advance_autopilot() {
  state_.is_booting = state_.is_booting && state_.up_ns(now_.world_ns) < traits_.boots_ns;
  state_.is_ready = state_.up_ns(now_.world_ns) >= traits_.ready_after_ns;
  state_.has_estimate = state_.has_position && state_.up_ns(now_.world_ns) >= traits_.estimate_after_ns;
  pilot_->on_time();
}

void vehicle::parts::advance_plans() {
  if (now_.real_ns < plans_.next_deadline_ns())
    return;
  const bool was_receiving = plans_.is_receiving();
  react(plans_.on_time(now_.real_ns), was_receiving);
}

void vehicle::parts::advance_params() {
  const auto there = out_.aim(params_line_);
  while (const auto value = params_.due(now_.real_ns))
    out_.send(*value);
}

void vehicle::parts::end_turn() {
  if (!is_starting_) {
    out_.end_turn();
    for (line_number number = 0; number < streams_.size(); ++number)
      if (const auto message = streams_[number].current.due(pilot_->progress(), now_.world_ns)) {
        const auto there = out_.aim(number);
        out_.send(*message);
      }
    pilot_->end_turn();
    if (pilot_->take_restart_request())
      reboot(now_.real_ns);
  }
  find_deadline();
}

void vehicle::parts::find_deadline() {
  if (is_starting_) {
    deadline_ns_ = silent_until_ns_;
    return;
  }
  auto world = std::min(craft_.next_step_ns(), pilot_->next_timer_ns());
  for (const auto& each : streams_)
    world = std::min(world, each.next_due_ns());
  if (settings_.aircraft != 0)
    world = std::min(world, next_aircraft_ns_);
  deadline_ns_ = std::min({clock_.real_ns(world), plans_.next_deadline_ns(), params_.next_due_ns()});
}

double vehicle::parts::load() const {
  if (!state_.is_armed)
    return battery::idle_load;
  const bool works = craft_.is_in_air() || craft_.is_moving();
  constexpr double armed_load = 0.05;
  return works ? 1 : armed_load;
}

// -- faults -----------------------------------------------------------------------------------------

void vehicle::parts::reboot(std::int64_t now_ns) {
  now_ = clock_.at(std::max(now_ns, now_.real_ns));
  is_starting_ = true;
  silent_until_ns_ = now_.real_ns + start_takes_ns;
  out_.be_silent(true);
  out_.restart();
  pilot_->set_now(now_);
  pilot_->restart();
  find_deadline();
}

void vehicle::parts::start_up() {
  is_starting_ = false;
  plans_.restart();
  out_.be_silent(false);
  state_.started_world_ns = now_.world_ns;
  tells_.restart();
  for (auto& each : streams_)
    each = make_streams();
  state_.is_booting = traits_.boots_ns > 0;
  static_cast<void>(tells_.send(mavlink::heartbeat::message_id, now_.world_ns)); // it is known
}

void vehicle::parts::lose_position(bool lost, std::int64_t now_ns) {
  advance(now_ns);
  pilot_->lose_position(lost);
  end_turn();
}

void vehicle::parts::block(bool is_blocked, std::int64_t now_ns) {
  advance(now_ns);
  pilot_->block(is_blocked);
  end_turn();
}

void vehicle::parts::breach_fence(std::int64_t now_ns) {
  advance(now_ns);
  pilot_->breach_fence();
  end_turn();
}

void vehicle::parts::set_battery(double percent, std::int64_t now_ns) {
  advance(now_ns);
  power_.set_percent(percent);
  advance(now_ns); // it may be empty now
  end_turn();
}

void vehicle::parts::say(std::string_view words, std::int64_t now_ns) {
  advance(now_ns);
  end_turn();
  out_.say_at_once(mavlink::mav_severity::warning, words);
}

void vehicle::parts::refuse_command(std::uint16_t command, std::uint8_t result, int times) {
  pilot_->refusals().refuse(command, result, times);
}

vehicle_picture vehicle::parts::describe() const {
  const auto& body = craft_.where();
  const auto progress = pilot_->progress();
  return {.where = body.where,
          .heading_deg = body.heading_deg,
          .roll_rad = body.roll_rad,
          .pitch_rad = body.pitch_rad,
          .ground_speed_mps = body.ground_speed_mps,
          .mode = std::string(state_.mode->name),
          .armed = state_.is_armed,
          .in_air = craft_.is_in_air(),
          .mission_state = std::string(word_for(craft_.mission().state())),
          .mission_current = progress.seq,
          .mission_count = craft_.mission().count(),
          .mission_id = progress.mission_id,
          .fence_count = static_cast<int>(plans_.plan(mavlink::mav_mission_type::fence).items.size()),
          .rally_count = static_cast<int>(plans_.plan(mavlink::mav_mission_type::rally).items.size()),
          .battery_percent = power_.percent(),
          .has_position = state_.has_position,
          .region_of_interest = craft_.region_of_interest(),
          .world_ms = state_.up_ns(now_.world_ns) / ns_per_ms};
}

} // namespace godwit::sim
