#include "programs/godwit-sim/vehicle/flight/flight.hpp"

#include <algorithm>

#include "programs/godwit-sim/vehicle/flight/item_legs.hpp"

namespace godwit::sim {

flight::flight(const craft& what, const position& home) : mover_(what, home), home_(home), pilot_(what) {}

void flight::set_task(const task::any& what) {
  if (what == task_)
    return;
  task_ = what;
  begin_task();
}

void flight::begin_task() {
  leg_list legs;
  if (const auto* go = std::get_if<task::go>(&task_))
    legs = legs_to({go->to, mover_.what().arrival_radius_m, true, go->speed_mps}, mover_);
  else if (const auto* climb = std::get_if<task::climb>(&task_); climb != nullptr && !mover_.is_rover())
    legs = {climb_leg{std::max(climb->altitude_m, mover_.ground_m() + min_flight_height_m)}};
  else if (std::holds_alternative<task::land>(task_) && mover_.is_vtol())
    legs = {change_leg{true}, land_leg{}};
  else if (std::holds_alternative<task::land>(task_))
    legs = {land_leg{}};
  else if (std::holds_alternative<task::come_back>(task_))
    legs = legs_home(home_, mover_);
  else if (std::holds_alternative<task::follow_mission>(task_))
    pilot_.resume();
  is_task_done_ = legs.empty();
  maneuver_.begin(std::move(legs));
}

happenings flight::advance(std::int64_t world_ns) {
  happenings said;
  // A vehicle that was at rest has nothing to catch up with, but for one step if it has been told something since.
  if (is_resting_)
    time_ns_ = std::max(time_ns_, is_settled() ? world_ns : world_ns - craft::step_ns);
  while (time_ns_ < world_ns) {
    const auto step_ns = std::min(craft::step_ns, world_ns - time_ns_);
    step(static_cast<double>(step_ns) * 1e-9, said);
    time_ns_ += step_ns;
    ++steps_;
    if (is_settled())
      time_ns_ = world_ns;
  }
  is_resting_ = is_settled();
  return said;
}

void flight::step(double step_s, happenings& said) {
  const bool was_in_air = mover_.is_in_air();
  const bool follows = std::holds_alternative<task::follow_mission>(task_);
  if (follows)
    pilot_.step(mover_, home_, step_s, said);
  else if (std::holds_alternative<task::rest>(task_))
    mover_.rest(step_s);
  else
    maneuver_.step(mover_, own_pace(mover_.what()), step_s);
  if (!follows)
    pilot_.moved_otherwise(where().where, said);
  if (mover_.is_in_air() != was_in_air)
    said.emplace_back(was_in_air ? happening(landed{}) : happening(took_off{}));
  if (follows)
    pilot_.settle(mover_, home_, said);
  if (is_task_done_ || !maneuver_.is_done())
    return;
  is_task_done_ = true;
  const bool is_landing = std::holds_alternative<task::land>(task_) ||
                          (std::holds_alternative<task::come_back>(task_) && mover_.is_multirotor());
  if (!is_landing)
    said.emplace_back(arrived{});
}

bool flight::is_settled() const {
  if (!mover_.is_still() || !is_task_done_)
    return false;
  if (std::holds_alternative<task::rest>(task_))
    return !mover_.is_in_air();
  return !std::holds_alternative<task::follow_mission>(task_) || pilot_.is_settled();
}

std::int64_t flight::next_step_ns() const { return is_settled() ? never_ns : time_ns_ + craft::step_ns; }

void flight::restart() {
  mover_.drop();
  mission().stop();
  task_ = task::rest{};
  begin_task();
}

} // namespace godwit::sim
