#include "actors/executor/flight/watches/control_watch.hpp"

#include <algorithm>
#include <utility>

#include "actors/executor/remaining.hpp"
#include "io/fields/field_table.hpp"
#include "io/mavlink/enums.hpp"
#include "runtime/planted_bug.hpp"

namespace godwit::executor {

// -- what the vehicle reports -----------------------------------------------------------------------

void control_watch::on_mode(instant now) {
  if (flight_.view.is_armed())
    was_armed_ = true;
  if (!judges_modes())
    return flight_.authority.on_heartbeat(now.now_ns);
  know_plan_end();
  if (flight_.is_in_flight() && !flight_.view.is_armed())
    flight_.authority.expect_also(flight_.modes_after_disarm(), now.now_ns, now.now_ns + flight::order_is_expected_ns);
  judge_mode(now);
}

void control_watch::on_current_mode(std::uint32_t intended, instant now) {
  if (!judges_modes())
    return;
  know_plan_end();
  const auto& view = flight_.view;
  flight_.authority.on_current_mode(view.owner(), {*view.mode(), view.is_critical(), intended}, now.now_ns);
}

// The modes that a failsafe of ours brings about are its own.
bool control_watch::judges_modes() const {
  const bool is_failsafes = flight_.failsafe_status && flight_.failsafe_status->reacts;
  return !is_failsafes && (flight_.is_starting() || flight_.is_in_flight());
}

void control_watch::on_place(instant now) {
  know_plan_end();
  judge_place(now);
}

void control_watch::on_foreign(const vehicle_link::foreign_act& m) {
  flight_.evidence.foreign_ns = std::max(flight_.evidence.foreign_ns, m.at_ns);
  if (m.kind == vehicle_link::foreign_kind::plan)
    return flight_.evidence.plan.doubt(m.at_ns);
  flight_.evidence.commanded_ns = m.at_ns;
  if (!judges_modes() || flight_.has_person())
    return;
  const auto command = static_cast<io::mavlink::mav_cmd>(m.command);
  const auto name = io::name_of(command);
  disarms_ = command == io::mavlink::mav_cmd::component_arm_disarm;
  who_acts_ = (m.system == 0 ? std::string("somebody else") : name_of(station{m.system, m.component})) +
              " commands the vehicle (" + (name.empty() ? std::to_string(m.command) : std::string(name)) + ")";
  flight_.authority.take_away(flight::holder::person);
}

void control_watch::judge_mode(instant now) {
  const auto& view = flight_.view;
  flight_.authority.on_mode(view.owner(), *view.mode(), view.is_critical(), now.now_ns);
}

void control_watch::judge_place(instant now) {
  const auto& view = flight_.view;
  if (view.current())
    flight_.authority.on_place(view.current()->seq, view.says_complete(), now.now_ns);
}

void control_watch::know_plan_end() {
  const auto generation = flight_.s.progress.last_generation;
  if (!flight_.view.mode() || known_end_ == generation)
    return;
  known_end_ = generation;
  flight_.authority.set_plan_end(end_of_plan(flight_.view.owner(), flight_.s));
}

// -- when it is watched -----------------------------------------------------------------------------

void control_watch::begin_start(effects& out) {
  flight_.authority.begin(*flight_.view.mode());
  who_acts_.clear();
  disarms_ = false;
  is_close_ = true;
  out.emplace_back(watch_vehicle{true});
  was_armed_ = flight_.view.is_armed();
  if (flight_.failsafe_status &&
      flight_.failsafe_status->taken_over) { // of a flight before; whoever starts this one hands it over
    flight_.failsafe_status->taken_over = false;
    out.emplace_back(send_to_failsafe{failsafe::hand_back{}});
  }
}

void control_watch::resume(std::vector<std::uint32_t> left_in, instant now) {
  know_plan_end();
  flight_.authority.resume(std::move(left_in), now.now_ns);
  judge_place(now);
  judge_mode(now);
}

void control_watch::end_flight() {
  flight_.authority.end();
  known_end_.reset();
}

// -- who has it -------------------------------------------------------------------------------------

bool control_watch::check_authority(effects& out, instant now) {
  if (is_close_ && !flight_.is_starting()) {
    is_close_ = false;
    out.emplace_back(watch_vehicle{false});
  }
  const bool is_ours_to_lose = flight_.is_in_flight() || flight_.is_starting();
  const auto& failsafe_status = flight_.failsafe_status;
  if (!is_ours_to_lose && flight_.has_person() && failsafe_status && failsafe_status->in_flight &&
      !failsafe_status->taken_over) {
    report_taken_over(out); // a flight that nobody has handed to us
    return true;
  }
  if (flight_.s.status.cause == pause_cause::taken_over &&
      flight_.authority.who() == flight::holder::autopilot_failsafe) { // its text came after its mode
    phases_.go(out, trigger::autopilot_failsafe_acts, "the autopilot's own failsafe acts" + in_its_mode());
    return true;
  }
  if (!is_ours_to_lose || flight_.has_person() || (flight_.is_starting() && GODWIT_PLANTED(repeat_start_over_person)))
    return false;
  if (!flight_.view.mode()) // not heard: a pilot may have it, and nothing is repeated but a stop
    return flight_.runner.is_busy() && !flight_.runner.is_stop();
  flight_.authority.on_time(now.now_ns);
  return judge_holder(out);
}

std::string control_watch::in_its_mode() const {
  const auto& mode = flight_.view.mode();
  return (mode ? " (mode " + std::string(io::name_of(mode->kind)) + ")" : std::string()) +
         "; nothing is sent until an operator hands it back";
}

// An autopilot that starts again is in a mode that nobody has chosen, and whoever stands beside it has it now.
std::string control_watch::who_has_it() const {
  const bool has_restarted = flight_.s.progress.paused == progress::pause_reason::vehicle_restarted;
  return has_restarted && !flight_.view.is_armed() ? "the autopilot started again; what it flew is lost"
                                                   : "a pilot has the vehicle";
}

bool control_watch::judge_holder(effects& out) {
  if (const auto& acts = flight_.failsafe_status->reacts)
    yield(out, trigger::failsafe_acts,
          "a failsafe acts (" + std::string(io::name_of(acts->why)) + ": " + std::string(io::name_of(acts->what)) +
              "); nothing else is sent until an operator hands the vehicle back");
  else if (flight_.authority.who() == flight::holder::autopilot_failsafe)
    yield(out, trigger::autopilot_failsafe_acts, "the autopilot's own failsafe acts" + in_its_mode());
  else if (flight_.is_starting() && was_armed_ && !flight_.view.is_armed())
    yield(out, trigger::person_took_over,
          "the vehicle was disarmed while it was started, and not by godwit; nothing is sent until an operator hands "
          "it back");
  else if (!flight_.authority.is_ours() || flight_.failsafe_status->taken_over)
    yield(out, trigger::person_took_over,
          who_acts_.empty() ? who_has_it() + in_its_mode()
                            : std::exchange(who_acts_, {}) + "; nothing is sent until an operator hands it back");
  else
    return flight_.authority.is_unclear();
  return true;
}

void control_watch::drop_all(effects& out, const std::string& why) {
  flight_.runner.drop(flight_.world({}, out));
  tasks_.end(out, why);
  if (const auto& start = flight_.wanted.start; start && start->asked)
    tasks_.answer_start(out, start->asked->key, start_verdict::not_ready, why);
  flight_.wanted.drop_all_after_takeover();
}

// It is not disarmed under somebody else's hands.
std::string control_watch::left_armed() const {
  const bool stands_armed = flight_.is_starting() && flight_.is_left_armed() && !disarms_;
  return stands_armed ? "; godwit has armed the vehicle, and it stands armed: whoever has it disarms it" : "";
}

void control_watch::look_at_left_armed(effects& out, instant now) {
  const auto& status = flight_.s.status;
  const bool waits = status.now == phase::paused && flight_.view.mode() && !flight_.has_person() &&
                     !flight_.is_in_flight() && !flight_.runner.is_busy();
  auto& runner = flight_.runner;
  if (!flight_.view.is_armed() && flight_.view.heartbeat_ns() > runner.armed_ns() + flight::silence_ns)
    runner.forget_armed(); // who arms it from now on is somebody else
  const bool may_be_started = status.cause == pause_cause::not_done || status.cause == pause_cause::restarted;
  if (waits && (runner.has_armed() || may_be_started) && flight_.is_in_air() &&
      !flight_.view.is_in(flight::mode_kind::mission))
    return yield(out, trigger::person_took_over,
                 "after a start that was not heard the vehicle is in the air, and not by its mission" + in_its_mode());
  const bool is_left =
      waits && flight_.is_left_armed() && !flight_.view.is_moving() && !flight_.view.is_in(flight::mode_kind::mission);
  const bool has_just_armed = now.now_ns - runner.armed_ns() <= flight::silence_ns;
  if (is_left && !reason_before_ && has_just_armed && tasks_.disarm_left_armed(out))
    return;
  if (is_left == reason_before_.has_value())
    return;
  if (is_left)
    reason_before_ = status.reason;
  const auto reason = is_left ? "the vehicle stands armed, by godwit's ARM or by somebody since: keep away from it; "
                                "whoever has it disarms it"
                              : *std::exchange(reason_before_, {});
  if (waits)
    phases_.go(out, trigger::start_waits, reason);
}

void control_watch::yield(effects& out, trigger to, const std::string& reason) {
  const auto why = reason + left_armed();
  if (!GODWIT_PLANTED(act_after_takeover))
    drop_all(out, why);
  if (to != trigger::failsafe_acts && (!flight_.failsafe_status || !flight_.failsafe_status->taken_over))
    report_taken_over(out);
  phases_.go(out, to, why);
}

void control_watch::report_taken_over(effects& out) {
  if (flight_.failsafe_status)
    flight_.failsafe_status->taken_over = true;
  out.emplace_back(send_to_failsafe{failsafe::taken_over{}});
}

void control_watch::find_taken(effects& out) {
  flight_.authority.take_away(flight::holder::person);
  yield(out, trigger::person_took_over,
        "somebody has changed the mode in the start in which godwit was restarted" + in_its_mode());
}

// Repeated for a failsafe that may have lost it; who has the vehicle does not change the phase twice.
void control_watch::give_to_station(effects& out, const station_act& m) {
  const bool is_new = flight_.s.status.cause != pause_cause::taken_over;
  const bool stands = !flight_.is_in_flight() && !flight_.is_starting() && !flight_.view.is_moving();
  flight_.authority.take_away(flight::holder::person);
  if (is_new)
    yield(out, stands ? trigger::person_acts_on_ground : trigger::person_took_over,
          name_of(m.by) + " has the vehicle (" + m.what + "); nothing is sent until it is handed back");
  else if (flight_.failsafe_status && !flight_.failsafe_status->taken_over)
    report_taken_over(out);
  if (is_new || flight_.s.person != m.by)
    out.emplace_back(note{station_took_over{m.by}});
}

bool control_watch::may_hand_back(const station& by) const {
  return flight_.s.status.cause == pause_cause::taken_over && flight_.s.person == by && flight_.view.is_connected() &&
         flight_.view.mode();
}

bool control_watch::take_back(effects& out) {
  if (!std::exchange(flight_.wanted.hand_back, false) || !flight_.has_person())
    return false;
  out.emplace_back(send_to_failsafe{failsafe::hand_back{}});
  if (flight_.failsafe_status) { // what still holds then is told anew
    flight_.failsafe_status->taken_over = false;
    flight_.failsafe_status->reacts.reset();
  }
  if (flight_.is_in_flight() && flight_.view.mode())
    flight_.authority.begin(*flight_.view.mode());
  else
    flight_.authority.end(); // nobody is watched before a start
  phases_.go(out, trigger::handed_back);
  return true;
}

} // namespace godwit::executor
