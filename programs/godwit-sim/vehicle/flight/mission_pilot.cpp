#include "programs/godwit-sim/vehicle/flight/mission_pilot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "actors/domain/mission/commands/command_table.hpp"
#include "programs/godwit-sim/vehicle/flight/item_legs.hpp"
#include "programs/godwit-sim/vehicle/flight/item_place.hpp"
#include "runtime/assert.hpp"

namespace godwit::sim {

void mission_pilot::resume() { is_interrupted_ = true; }

void mission_pilot::step(mover& vehicle, position& home, double step_s, happenings& said) {
  if (run_.starts() != seen_starts_) {
    how_fast_ = own_pace(vehicle.what());
    region_.reset();
  }
  seen_starts_ = run_.starts();
  if (run_.changes() != seen_changes_) {
    commands_.clear();
    commands_wait_s_ = commands_wait_m_ = 0;
    trigger_m_ = keeps_trigger_ ? trigger_m_ : 0;
    begin(vehicle, home, said);
  } else if (is_interrupted_) {
    go_on(vehicle, home, said);
  }
  is_interrupted_ = false;
  commands_wait_s_ = std::max(0.0, commands_wait_s_ - step_s);
  execute_due(vehicle, home, said);
  if (run_.state() == run_state::idle)
    vehicle.hold(step_s);
  else
    maneuver_.step(vehicle, how_fast_, step_s);
  move_load(step_s, said);
  trigger(vehicle.where().where, said);
}

void mission_pilot::move_load(double step_s, happenings& said) {
  if (load_wait_s_ <= 0)
    return;
  load_wait_s_ -= step_s;
  if (load_wait_s_ <= 0)
    said.emplace_back(load_moved{is_released_});
}

void mission_pilot::moved_otherwise(const position& here, happenings& said) {
  if (keeps_trigger_)
    trigger(here, said);
  else
    trigger_m_ = 0;
}

void mission_pilot::trigger(const position& here, happenings& said) {
  if (trigger_m_ <= 0 || between(pictured_at_, here).distance_m < trigger_m_)
    return;
  pictured_at_ = here;
  said.emplace_back(pictured{});
}

void mission_pilot::execute(const io::mavlink::mission_item_int& command, const position& here, happenings& said) {
  switch (command.command) {
  case do_set_cam_trigg_dist:
    trigger_m_ = std::max(0.0F, command.param1);
    pictured_at_ = here;
    if (command.param3 == 1)
      said.emplace_back(pictured{});
    break;
  case image_start_capture:
    if (command.param3 == 1)
      said.emplace_back(pictured{});
    break;
  case do_gripper: {
    constexpr double actuation_s = 0.5;
    load_wait_s_ = actuation_s;
    is_released_ = command.param2 == 0;
    break;
  }
  case do_vtol_transition: {
    constexpr float to_rotors = 3; // MAV_VTOL_STATE_MC
    hovers_ = command.param1 == to_rotors;
    break;
  }
  default:
    break;
  }
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
  queue_commands();
  run_.advance();
  if (!run_.is_held())
    begin(vehicle, home, said);
}

bool mission_pilot::is_settled() const {
  return run_.changes() == seen_changes_ && !is_interrupted_ && commands_.empty() && load_wait_s_ <= 0 &&
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
    else
      queue_commands();
    run_.skip();
  }
  seen_changes_ = run_.changes();
  if (!maneuver_.is_done()) // of an item that was left
    maneuver_.begin({});
  if (run_.state() != run_state::completed)
    return;
  execute_all(vehicle, home, said);
  said.emplace_back(mission_completed{});
}

// False: it is nothing to fly.
bool mission_pilot::begin_nav(const mover& vehicle, position& home, happenings& said) {
  execute_due(vehicle, home, said);
  return plan(vehicle, home, said);
}

void mission_pilot::queue_commands() {
  for (int sequence = run_.current() + 1; sequence < run_.commands_end(); ++sequence)
    commands_.push_back(sequence);
}

bool mission_pilot::plan(const mover& vehicle, const position& home, happenings& said) {
  const auto command = run_.item()->command;
  const bool takes_off = command == nav_takeoff || command == nav_vtol_takeoff;
  if (takes_off)
    hovers_ = false; // from there on
  auto legs = legs_of(*run_.item(), {vehicle, home, here_, how_fast_, run_.goes_on(), hovers_});
  if (!legs) {
    said.emplace_back(item_skipped{run_.current(), std::move(legs).error()});
    return false;
  }
  const bool changes = vehicle.is_vtol() && vehicle.is_in_air() && vehicle.is_multirotor() != hovers_;
  if (changes && !takes_off && command != nav_vtol_land)
    legs->insert(legs->begin(), change_leg{hovers_});
  maneuver_.begin(*std::move(legs));
  return true;
}

void mission_pilot::execute_next(const mover& vehicle, position& home, happenings& said) {
  const int sequence = commands_.front();
  commands_.pop_front();
  const auto& command = run_.items()[static_cast<std::size_t>(sequence)];
  if (command.command == condition_delay && command.param1 > 0)
    commands_wait_s_ = static_cast<double>(command.param1);
  if (command.command == condition_distance && command.param1 > 0)
    commands_wait_m_ = static_cast<double>(command.param1);
  auto reason = execute_command(command, vehicle.what(), vehicle.where().where, how_fast_, home);
  if (reason)
    return void(said.emplace_back(item_skipped{sequence, *std::move(reason)}));
  if (command.command != do_jump)
    said.emplace_back(command_executed{sequence});
  if (command.command == do_set_roi_location || command.command == do_set_roi)
    if (const auto place = place_of(command, home, vehicle.where().where))
      region_ = place->at;
  if (command.command == do_set_roi_none)
    region_.reset();
  execute(command, vehicle.where().where, said);
}

bool mission_pilot::are_held_back(const mover& vehicle, const position& home) const {
  if (commands_wait_s_ > 0 || commands_wait_m_ <= 0 || run_.item() == nullptr)
    return commands_wait_s_ > 0;
  const auto place = place_of(*run_.item(), home, here_);
  return place && between(vehicle.where().where, place->at).distance_m > commands_wait_m_;
}

void mission_pilot::execute_due(const mover& vehicle, position& home, happenings& said) {
  while (!commands_.empty() && !are_held_back(vehicle, home)) {
    commands_wait_m_ = 0;
    execute_next(vehicle, home, said);
  }
}

void mission_pilot::execute_all(const mover& vehicle, position& home, happenings& said) {
  while (!commands_.empty())
    execute_next(vehicle, home, said);
  commands_wait_s_ = commands_wait_m_ = 0;
}

void mission_pilot::drop_late(happenings& said) {
  for (const int sequence : std::exchange(commands_, {}))
    said.emplace_back(item_skipped{sequence, "its delay was longer than the item beside it"});
  commands_wait_s_ = commands_wait_m_ = 0;
}

using io::mavlink::mission_item_int;
using mission::command_class;

namespace {

// Who is slower than this never arrives; faster than this a step is no longer small.
constexpr double min_speed_mps = 0.1;
constexpr double max_speed_mps = 20;
constexpr float craft_default = -2;

std::optional<std::string> change(double& speed_mps, float wanted_mps, double own_mps, double least_mps) {
  if (wanted_mps == craft_default)
    speed_mps = own_mps;
  else if (wanted_mps > 0)
    speed_mps = std::clamp(static_cast<double>(wanted_mps), least_mps, max_speed_mps);
  else if (wanted_mps != -1) // -1 keeps it
    return "it names no speed";
  return std::nullopt;
}

std::optional<std::string> change_speed(const mission_item_int& command, const craft& what, pace& how_fast) {
  const auto own = own_pace(what);
  if (command.param1 == 0 || command.param1 == 1)
    return change(how_fast.speed_mps, command.param2, own.speed_mps, std::max(min_speed_mps, what.min_speed_mps));
  if (command.param1 == 2)
    return change(how_fast.climb_mps, command.param2, own.climb_mps, min_speed_mps);
  if (command.param1 == 3)
    return change(how_fast.descent_mps, command.param2, own.descent_mps, min_speed_mps);
  return "this kind of speed is not known";
}

// By some vehicle, as an item. What is guarded is not known here.
bool is_executed(std::uint16_t command) {
  const auto* const row = mission::command_of(command);
  if (row == nullptr || !row->is_taken_by_anyone())
    return false;
  return row->kind == command_class::acts || row->kind == command_class::waits || row->kind == command_class::flow ||
         row->kind == command_class::moves;
}

} // namespace

std::optional<std::string> execute_command(const mission_item_int& command, const craft& what, const position& here,
                                           pace& how_fast, position& home) {
  switch (command.command) {
  case do_change_speed:
    return change_speed(command, what, how_fast);
  case do_set_home: {
    if (command.param1 == 1) {
      home = here;
      return std::nullopt;
    }
    const auto place = place_of(command, home, here);
    if (!place)
      return place.error();
    home = place->at;
    return std::nullopt;
  }
  case do_jump:
  case do_land_start:
  case condition_delay:
  case condition_distance:
    return std::nullopt;
  default:
    break;
  }
  if (is_executed(command.command))
    return std::nullopt; // cameras, servos and the like: nothing here moves by it
  return "command " + std::to_string(command.command) + " is not known";
}

} // namespace godwit::sim
