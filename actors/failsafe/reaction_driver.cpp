#include "actors/failsafe/reaction_driver.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "actors/failsafe/events.hpp"
#include "runtime/assert.hpp"

namespace godwit::failsafe {

using vehicle_link::command_verdict;

reaction_driver::reaction_driver(const std::optional<reaction>& restored, std::uint64_t last_number,
                                 std::int64_t now_ns)
    : current_(restored), last_number_(last_number), since_ns_(now_ns) {}

void reaction_driver::begin(rule why, action what) {
  current_ = reaction{.why = why, .what = what};
  verdict_.reset();
  failed_ = false;
  said_disobeyed_ = false;
}

void reaction_driver::raise(rule why) {
  GODWIT_ASSERT(current_, "failsafe: what is raised is there");
  if (is_higher(why, current_->why))
    current_->why = why;
}

void reaction_driver::on_resolved(const command_resolved& what) {
  if (what.number == last_number_ && current_ && current_->phase == reaction_phase::in_flight)
    verdict_ = what.verdict;
}

reaction_stage reaction_driver::stage() const {
  GODWIT_ASSERT(current_, "failsafe: who asks how far a reaction is has one");
  if (current_->phase == reaction_phase::done)
    return reaction_stage::done;
  return failed_ ? reaction_stage::failing : reaction_stage::under_way;
}

void reaction_driver::enter(reaction_phase phase, std::int64_t now_ns) {
  current_->phase = phase;
  since_ns_ = now_ns;
}

bool reaction_driver::is_overdue(std::int64_t limit_ms, std::int64_t now_ns) const {
  return now_ns - since_ns_ >= limit_ms * ns_per_ms;
}

void reaction_driver::take_verdict(command_verdict verdict, std::int64_t now_ns) {
  switch (verdict) {
  case command_verdict::accepted:
    failed_ = said_disobeyed_; // then the mode has to show it
    enter(reaction_phase::accepted, now_ns);
    return;
  case command_verdict::timed_out:
  case command_verdict::vehicle_restarted:
    enter(reaction_phase::unsure, now_ns);
    return;
  case command_verdict::refused:
  case command_verdict::invalid:
    if (current_->what == action::do_land_start) // the plan on the vehicle has none after all
      current_->what = action::return_home;
    break;
  case command_verdict::outdated: // judged anew with the heartbeat that is on its way here; that was no try
    current_->tries -= current_->tries > 0 ? 1 : 0;
    break;
  case command_verdict::not_sent:
  case command_verdict::already_running:
  case command_verdict::too_many:
    break;
  }
  enter(reaction_phase::to_send, now_ns);
}

void reaction_driver::resolve(const look& seen, std::int64_t now_ns) {
  const auto verdict = std::exchange(verdict_, std::nullopt);
  if (is_done(seen)) {
    if (current_->phase != reaction_phase::done)
      enter(reaction_phase::done, now_ns);
    return;
  }
  if (is_left(seen)) {
    enter(reaction_phase::to_send, now_ns);
    return;
  }
  if (current_->phase == reaction_phase::in_flight) {
    if (verdict)
      take_verdict(*verdict, now_ns);
    else if (is_overdue(command_answer_ms, now_ns))
      enter(reaction_phase::unsure, now_ns);
  } else if (current_->phase == reaction_phase::unsure && seen.heartbeat_ns > since_ns_) {
    look_again(seen, now_ns);
  }
}

// No mode shows that a plan goes on at its landing, its sequence does. Where that does not come, a return can be seen.
void reaction_driver::look_again(const look& seen, std::int64_t now_ns) {
  if (current_->what == action::do_land_start && seen.sequence_ns <= since_ns_) {
    if (!is_overdue(obedience_ms, now_ns))
      return;
    current_->what = action::return_home;
  }
  enter(reaction_phase::to_send, now_ns);
}

bool reaction_driver::is_done(const look& seen) const {
  return is_done_by(current_->what, seen.mode) ||
         (current_->what == action::do_land_start && seen.mode == mode_kind::mission && seen.on_landing);
}

bool reaction_driver::is_left(const look& seen) const {
  const auto wanted = modes_of(current_->what);
  return current_->phase == reaction_phase::done && seen.is_ours &&
         std::find(wanted.begin(), wanted.end(), seen.mode) == wanted.end();
}

bool reaction_driver::is_disobeyed(const look& seen, std::int64_t now_ns) const {
  const bool can_be_seen =
      current_->what == action::do_land_start ? seen.sequence_ns > since_ns_ : seen.heartbeat_ns > since_ns_;
  return current_->phase == reaction_phase::accepted && can_be_seen && is_overdue(obedience_ms, now_ns);
}

reaction_driver::step reaction_driver::drive(const look& seen, std::int64_t now_ns) {
  step result;
  if (!current_)
    return result;
  const auto before = current_->phase;
  resolve(seen, now_ns);
  result.was_left = before == reaction_phase::done && current_->phase == reaction_phase::to_send;
  const bool has_failed =
      current_->phase == reaction_phase::unsure || (current_->phase == reaction_phase::to_send && current_->tries > 0);
  if (has_failed && !result.was_left)
    result.fails_first = !std::exchange(failed_, true);
  if (is_disobeyed(seen, now_ns)) {
    result.disobeyed = !std::exchange(said_disobeyed_, true);
    failed_ = true;
    enter(reaction_phase::to_send, now_ns);
  }
  if (current_->phase == reaction_phase::to_send && seen.may_send) {
    constexpr std::uint32_t most = std::numeric_limits<std::uint8_t>::max();
    result.send = command_vehicle{++last_number_, current_->why, current_->what,
                                  static_cast<std::uint8_t>(std::min(current_->tries, most))};
    ++current_->tries;
    enter(reaction_phase::in_flight, now_ns);
  }
  return result;
}

} // namespace godwit::failsafe
