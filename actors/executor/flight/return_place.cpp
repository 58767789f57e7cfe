#include "actors/executor/flight/return_place.hpp"

#include <string>
#include <utility>

namespace godwit::executor {
namespace {

constexpr std::int64_t answer_ms = 450;

kept_home kept(const plan::vehicle_home& told) { return {plan::place_of(told), false}; }

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
  const auto& told = flight_.view.home();
  if (!flight_.is_in_flight() || flight_.has_person() || !told || (home && (home->is_resolved || *home == kept(*told))))
    return false;
  out.emplace_back(note{home_kept{kept(*told)}});
  return true;
}

bool return_place::advance(effects& out, instant now) {
  if (flight_.is_in_flight()) {
    if (!flight_.s.home && keep(out))
      return true;
    look(out, now);
    return false;
  }
  since_ns_ = 0;
  flight_.is_home_told = flight_.is_home_told && flight_.is_starting();
  return free_home(out);
}

void return_place::look(effects& out, instant now) {
  if (!flight_.keeps_home() || flight_.has_person() || !flight_.authority.is_ours())
    return;
  if (since_ns_ == 0) {
    since_ns_ = now.now_ns;
    asked_ns_ = 0;
    is_told_ = false;
  }
  if (!flight_.returns_elsewhere()) {
    if (std::exchange(is_told_, false))
      out.emplace_back(announce{"home is that of the mission again", false});
    return;
  }
  if (is_told_)
    return;
  if (now.now_ns - since_ns_ >= told_within_ns)
    return tell(out);
  if (now.now_ns - asked_ns_ < asked_each_ns)
    return;
  asked_ns_ = now.now_ns;
  auto request = home_request();
  request.timeout_ms = answer_ms;
  out.emplace_back(order{goes::at_once, ++last_request_, now.now_ns, {}, request});
}

// It holds once; who says resume goes on all the same, and has been told.
void return_place::tell(effects& out) {
  is_told_ = true;
  const auto why = "held, because home is not known to be that of the mission: " + flight_.home_sentence() +
                   "; come_home flies to the mission's by a plan, resume goes on";
  out.emplace_back(announce{why, true});
  const auto at = flight_.s.status.now;
  if ((at != phase::flying && at != phase::landing) || flight_.wanted.halt)
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
  tasks_.begin(out, task_kind::free_home, {executor::free_home{}});
  return true;
}

} // namespace godwit::executor
