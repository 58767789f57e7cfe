#include "actors/executor/flight/return_place.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "actors/domain/home/home.hpp"
#include "actors/executor/plan/vehicle_items.hpp"
#include "actors/executor/remaining.hpp"

namespace godwit::executor {
namespace {

constexpr std::int64_t answer_ms = 450;

kept_home kept(const flight_context& flight) {
  const auto told = plan::place_of(*flight.view.home());
  const auto& flown = flight.s.flown;
  const auto at = flown ? flight::home_of_arming(told, flown->home) : told;
  return {at, flight.is_home_told, flight.is_home_told};
}

} // namespace

effects return_place::on_home() {
  effects out;
  flight_.is_home_told =
      flight_.is_home_told || (flight_.view.is_armed() && (flight_.is_in_flight() || flight_.is_starting()));
  static_cast<void>(keep(out));
  return out;
}

// Of the first flight.
bool return_place::keep(effects& out) const {
  const auto& home = flight_.s.home;
  if (!flight_.is_in_flight() || flight_.has_person() || !flight_.view.home() ||
      (home && (home->is_resolved || *home == kept(flight_))))
    return false;
  out.emplace_back(note{home_kept{kept(flight_)}});
  return true;
}

bool return_place::advance(effects& out, instant now) {
  if (flight_.is_in_flight()) {
    if ((!flight_.s.home || !flight_.keeps_home()) && keep(out))
      return true;
    look(out, now);
    return false;
  }
  since_ns_ = 0;
  was_right_ = is_led_back_ = is_brought_anew_ = flight_.is_home_moved = false;
  flight_.is_home_told = flight_.is_home_told && flight_.is_starting();
  return free_home(out);
}

void return_place::look(effects& out, instant now) {
  if (since_ns_ == 0) {
    since_ns_ = now.now_ns;
    asked_ns_ = 0;
    is_told_ = false;
  }
  const bool is_ours = !flight_.has_person() && flight_.authority.is_ours();
  const auto heard_ns = std::max(flight_.view.home_heard_ns(), since_ns_);
  if (is_ours && flight_.view.is_connected() && now.now_ns - heard_ns >= missed_after_ns)
    ask(out, now, watched_each_ns);
  if (!flight_.keeps_home())
    return;
  const bool is_elsewhere = flight_.returns_elsewhere();
  was_right_ = was_right_ || !is_elsewhere || flight_.s.home->is_of_this_flight;
  const bool was_moved = std::exchange(flight_.is_home_moved, is_elsewhere && was_right_);
  if (flight_.is_home_moved && !was_moved)
    tell_moved(out);
  if (!is_ours)
    return;
  if (!is_elsewhere) {
    is_led_back_ = is_brought_anew_ = false;
    if (std::exchange(is_told_, false))
      out.emplace_back(announce{"home is that of the mission again", false});
    return;
  }
  if (flight_.is_home_moved)
    return lead_back(out);
  if (is_told_)
    return;
  if (now.now_ns - since_ns_ >= told_within_ns)
    return tell(out);
  ask(out, now, asked_each_ns);
}

void return_place::ask(effects& out, instant now, std::int64_t each_ns) {
  if (now.now_ns - asked_ns_ < each_ns)
    return;
  asked_ns_ = now.now_ns;
  auto request = home_request();
  request.timeout_ms = answer_ms;
  out.emplace_back(order{goes::at_once, ++last_request_, now.now_ns, {}, request});
}

void return_place::tell_moved(effects& out) {
  is_told_ = true;
  out.emplace_back(
      announce{"somebody has moved the vehicle's home: " + flight_.home_sentence() +
                   "; returns of godwit lead to the mission's home, a pilot's and the vehicle's own do not",
               true});
}

// By its mode, or by the last item of its plan.
bool return_place::returns_by_itself() const {
  const auto& view = flight_.view;
  const auto* const last = last_flown_item(flight_.s);
  const bool ends_with_return = last != nullptr && plan::is_return_item(*last);
  return view.is_under_way() &&
         (view.is_in(flight::mode_kind::returning) ||
          (ends_with_return && view.is_in(flight::mode_kind::mission) && flight_.is_at_end_of_plan()));
}

// Once for each move, and of what is flown.
void return_place::lead_back(effects& out) {
  if (flight_.runner.is_busy() || flight_.wanted.halt || flight_.homing.at != homing_stage::none ||
      flight_.has_open_intent())
    return;
  if (returns_by_itself()) {
    if (std::exchange(is_led_back_, true))
      return;
    out.emplace_back(announce{"the vehicle returns to another place than the home of the mission: it is called home by "
                              "a plan",
                              true});
    flight_.wanted.put_halt(task_kind::come_home);
    return;
  }
  const auto& flown = flight_.s.flown;
  const bool has_return = flown && std::ranges::any_of(flown->items, plan::is_return_item);
  const bool may_be_brought = flight_.s.status.now == phase::flying && flight_.may_change_plan() &&
                              flight_.view.is_in(flight::mode_kind::mission) && !flight_.is_plan_finished() &&
                              !flight_.is_on_way_home();
  if (!has_return || !may_be_brought || std::exchange(is_brought_anew_, true))
    return;
  flight_.wanted.bring_return_anew = true;
}

// It holds once; who says resume goes on all the same, and has been told.
void return_place::tell(effects& out) {
  is_told_ = true;
  const auto why = "held, because home is not known to be that of the mission: " + flight_.home_sentence() +
                   "; come_home flies to the mission's by a plan, resume goes on";
  out.emplace_back(announce{why, true});
  if (!is_on_way(flight_.s.status.now) || flight_.wanted.halt)
    return;
  flight_.wanted.put_halt(task_kind::hold);
  flight_.wanted.why_halt = why;
}

bool return_place::free_home(effects& out) {
  const auto& s = flight_.s;
  const bool is_mission_over = is_over(s.status.now) || !s.home;
  if (!s.has_commanded_home || !is_mission_over || flight_.has_person() || flight_.runner.is_busy() ||
      !flight_.view.is_connected() || !flight_.view.mode() || flight_.view.is_armed())
    return false;
  tasks_.begin(out, task_kind::free_home, {reset_home{}});
  return true;
}

} // namespace godwit::executor
