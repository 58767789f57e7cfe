#include "programs/godwit-sim/vehicle/flight/mission_pilot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "programs/godwit-sim/vehicle/flight/do_command.hpp"
#include "programs/godwit-sim/vehicle/flight/item_legs.hpp"
#include "programs/godwit-sim/vehicle/flight/mission_commands.hpp"
#include "runtime/assert.hpp"

namespace godwit::sim {

void mission_pilot::resume() { is_interrupted_ = true; }

void mission_pilot::step(mover& vehicle, position& home, double step_s, happenings& said) {
  if (run_.starts() != seen_starts_)
    how_fast_ = own_pace(vehicle.what());
  seen_starts_ = run_.starts();
  if (run_.changes() != seen_changes_) {
    commands_.clear();
    commands_wait_s_ = 0;
    begin(vehicle, home, said);
  } else if (is_interrupted_) {
    go_on(vehicle, home, said);
  }
  is_interrupted_ = false;
  commands_wait_s_ = std::max(0.0, commands_wait_s_ - step_s);
  carry_out_due(vehicle, home, said);
  if (run_.state() == run_state::idle)
    vehicle.hold(step_s);
  else
    maneuver_.step(vehicle, how_fast_, step_s);
}

void mission_pilot::go_on(const mover& vehicle, const position& home, happenings& said) {
  if (run_.item() == nullptr) {
    maneuver_.begin({});
    return;
  }
  const bool is_planned = plan(vehicle, home, said);
  GODWIT_ASSERT(is_planned, "an item that has begun can go on");
}

void mission_pilot::settle(const mover& vehicle, position& home, happenings& said) {
  if (run_.item() == nullptr || !maneuver_.is_done() || run_.changes() != seen_changes_)
    return;
  said.emplace_back(item_reached{run_.current()});
  drop_late(said);
  run_.advance();
  if (!run_.is_held())
    begin(vehicle, home, said);
}

bool mission_pilot::is_settled() const {
  return run_.changes() == seen_changes_ && !is_interrupted_ && commands_.empty() &&
         (run_.item() == nullptr || maneuver_.is_settled());
}

// Goes on through the plan until there is something to fly. It ends, because a run does not jump for ever.
void mission_pilot::begin(const mover& vehicle, position& home, happenings& said) {
  while (const auto* item = run_.item()) {
    seen_changes_ = run_.changes();
    here_ = vehicle.where().where;
    said.emplace_back(item_begun{run_.current()});
    if (!is_nav(*item))
      commands_.push_back(run_.current());
    else if (begin_nav(vehicle, home, said))
      return;
    run_.skip();
  }
  seen_changes_ = run_.changes();
  if (!maneuver_.is_done()) // of an item that was left
    maneuver_.begin({});
  if (run_.state() != run_state::completed)
    return;
  carry_out_all(vehicle, home, said);
  said.emplace_back(mission_completed{});
}

// False: it is nothing to fly.
bool mission_pilot::begin_nav(const mover& vehicle, position& home, happenings& said) {
  for (int sequence = run_.current() + 1; sequence < run_.commands_end(); ++sequence)
    commands_.push_back(sequence);
  carry_out_due(vehicle, home, said);
  return plan(vehicle, home, said);
}

bool mission_pilot::plan(const mover& vehicle, const position& home, happenings& said) {
  auto legs = legs_of(*run_.item(), {vehicle, home, here_, how_fast_, run_.goes_on()});
  if (!legs) {
    said.emplace_back(item_skipped{run_.current(), std::move(legs).error()});
    return false;
  }
  maneuver_.begin(*std::move(legs));
  return true;
}

void mission_pilot::carry_out_next(const mover& vehicle, position& home, happenings& said) {
  const int sequence = commands_.front();
  commands_.pop_front();
  const auto& command = run_.items()[static_cast<std::size_t>(sequence)];
  if (command.command == condition_delay && command.param1 > 0)
    commands_wait_s_ = static_cast<double>(command.param1);
  auto reason = carry_out(command, vehicle.what(), vehicle.where().where, how_fast_, home);
  if (reason)
    said.emplace_back(item_skipped{sequence, *std::move(reason)});
}

void mission_pilot::carry_out_due(const mover& vehicle, position& home, happenings& said) {
  while (!commands_.empty() && commands_wait_s_ <= 0)
    carry_out_next(vehicle, home, said);
}

void mission_pilot::carry_out_all(const mover& vehicle, position& home, happenings& said) {
  while (!commands_.empty())
    carry_out_next(vehicle, home, said);
  commands_wait_s_ = 0;
}

void mission_pilot::drop_late(happenings& said) {
  for (const int sequence : std::exchange(commands_, {}))
    said.emplace_back(item_skipped{sequence, "its delay was longer than the item beside it"});
  commands_wait_s_ = 0;
}

} // namespace godwit::sim
