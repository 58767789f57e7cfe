#include "actors/executor/flight/flight_end.hpp"

#include <utility>

namespace godwit::executor {
namespace {

using flight::mode_kind;

constexpr std::int64_t stands_ns = 2'000'000'000;           // disarmed for so long, before its mode is changed
constexpr double rally_radius_m = 8;                        // as of home
constexpr std::int64_t last_word_within_ns = 4'000'000'000; // MISSION_CURRENT comes once a second, and may be lost

bool is_open(phase now) { return !is_over(now) && now != phase::starting && !is_on_way(now); }

} // namespace

void flight_end::on_heartbeat(instant now) {
  if (flight_.view.is_armed()) {
    disarmed_since_ns_ = 0;
    has_stood_by_ = false;
    was_put_there_ = false;
  } else if (disarmed_since_ns_ == 0) {
    disarmed_since_ns_ = now.now_ns;
  }
}

bool flight_end::is_down(instant now) const {
  const auto& view = flight_.view;
  if (!view.is_armed())
    return true;
  if (!flight_.drives())
    return flight_.is_plan_finished() && flight_.was_up && !view.is_under_way();
  if (view.is_in(mode_kind::returning)) // ArduPilot's rover stays in that mode
    return (flight_.was_called_home() || flight_.is_plan_finished()) &&
           (view.stands_at_home(now.now_ns) || (view.stands() && flight_.is_at_rally_point(rally_radius_m, now)));
  const bool holds_on_the_way = flight_.s.status.now == phase::paused || flight_.homing.at != homing_stage::none;
  return flight_.is_plan_finished() || (flight_.was_called_home() && view.is_in(mode_kind::hold) && !holds_on_the_way);
}

bool flight_end::was_brought_down(instant now) const {
  return !flight_.view.is_armed() && !flight_.has_person() && flight_.authority.is_ours() &&
         progress::is_at_last_movement(flight_.s.progress) && flight_.came_down_as_planned(now);
}

bool flight_end::end_flight(effects& out, instant now) {
  if (!flight_.view.is_connected() || !flight_.view.mode())
    return false;
  if (!flight_.is_in_flight())
    return end_late(out);
  if (!is_down(now)) {
    down_since_ns_ = 0;
    return false;
  }
  if (down_since_ns_ == 0)
    down_since_ns_ = now.now_ns;
  const bool is_told = flight_.is_plan_finished() || flight_.was_called_home();
  if (!is_told && now.now_ns - down_since_ns_ < last_word_within_ns)
    return false; // how far it came is told after it is down, where the line was silent before
  if (was_brought_down(now))
    out.emplace_back(note{progress::came_down{}});
  else
    close(out);
  return true;
}

// Its last message came after the end of the flight, or when the next plan was brought already.
bool flight_end::end_late(effects& out) {
  const auto& s = flight_.s;
  const auto& open = s.progress.mission;
  const bool is_complete = open && open->completed_revision == open->revision;
  if (!is_open(s.status.now) || s.doing || !(flight_.is_mission_finished() || is_complete) || !s.mission ||
      !flight_.has_nothing_left(*s.mission))
    return false;
  end_mission(out);
  return true;
}

void flight_end::close(effects& out) {
  down_since_ns_ = 0;
  watch_.end_flight();
  flight_.wanted.drop_all_of_flight();
  flight_.was_up = false;
  if (flight_.s.preflight.now != preflight::phase::idle)
    out.emplace_back(note{preflight::flight_ended{}});
  if (flight_.s.mission && flight_.s.deleted_mission == flight_.s.mission->mission_id)
    out.emplace_back(announce{"the flight has ended, and the service has deleted its mission " +
                                  flight_.s.deleted_mission + " meanwhile: what was seen and done is kept on board",
                              true});
  if (flight_.is_mission_finished() || flight_.was_called_home())
    end_mission(out);
  else
    phases_.go(out, trigger::flight_ended);
}

// Its vehicle may be lost, or stand: what was under way is given up, and nothing is sent.
bool flight_end::end_by_person(effects& out, instant now) {
  if (!std::exchange(flight_.wanted.end_flight, false) || !flight_.keeps_vehicle())
    return false;
  flight_.runner.drop(flight_.world(now, out));
  tasks_.end(out, "a person has ended the flight");
  flight_.homing = {};
  flight_.wanted = {};
  down_since_ns_ = 0;
  watch_.end_flight();
  flight_.was_up = false;
  if (flight_.s.preflight.now != preflight::phase::idle)
    out.emplace_back(note{preflight::flight_ended{}});
  out.emplace_back(note{progress::mission_aborted{}});
  out.emplace_back(announce{"a person has ended the flight: its vehicle is not waited for any more", true});
  end_mission(out, "a person has ended the flight");
  return true;
}

bool flight_end::leave_mission_mode(effects& out, instant now) {
  const auto& view = flight_.view;
  if (flight_.awaited_arming) { // it stands there because its station has said so
    has_stood_by_ = false;
    was_put_there_ = true;
    return false;
  }
  const auto& paused = flight_.s.progress.paused;
  const bool is_our_plan = flight_.s.flown && paused != progress::pause_reason::vehicle_restarted &&
                           paused != progress::pause_reason::foreign_plan;
  was_told_to_hold_ = was_told_to_hold_ && view.is_armed() && !flight_.is_in_flight();
  if (flight_.is_in_flight() || flight_.runner.is_busy() || !view.is_connected())
    return false;
  if (view.is_armed())
    return is_our_plan && hold_where_mission_ended(out);
  if (has_stood_by_ || !(is_our_plan || was_put_there_))
    return false;
  if (!view.is_in(mode_kind::mission) || disarmed_since_ns_ == 0 || now.now_ns - disarmed_since_ns_ < stands_ns)
    return false;
  has_stood_by_ = true;
  tasks_.begin(out, task_kind::stand_by, {safe_ground_mode{}});
  return true;
}

bool flight_end::hold_where_mission_ended(effects& out) {
  const auto& view = flight_.view;
  const bool stands_at_end = view.owner().vehicle == flight::vehicle_class::rover && view.is_in(mode_kind::mission) &&
                             view.says_complete() && view.stands();
  if (!stands_at_end || !is_over(flight_.s.status.now) || flight_.has_person() || was_told_to_hold_)
    return false;
  was_told_to_hold_ = true;
  out.emplace_back(
      announce{"the mission is over and the vehicle stands armed in its mission mode: it is commanded to hold. "
               "Disarm it before anybody comes near",
               true});
  tasks_.begin(out, task_kind::stand_by, {safe_ground_mode{true}});
  return true;
}

// Who has the vehicle still has it after the end of the mission: the next one waits for a hand-back.
std::string flight_end::who_keeps_it() const {
  const bool is_person = flight_.s.status.cause == pause_cause::taken_over;
  return std::string(is_person ? "somebody else has the vehicle" : "a failsafe took the vehicle") +
         "; hand it back before another mission";
}

void flight_end::end_mission(effects& out, const std::string& why) {
  if (flight_.has_service())
    out.emplace_back(send_to_client{mission_client::push_map{flight_.s.mission->mission_id}});
  phases_.go(out, trigger::mission_ended, flight_.has_person() ? who_keeps_it() : why);
}

} // namespace godwit::executor
