// What the steps of a task ask for, and how people are told of it.
#include <cmath>
#include <utility>

#include "actors/domain/control_authority/mode_tables.hpp"
#include "actors/executor/announced_modes.hpp"
#include "actors/executor/task_runner.hpp"
#include "io/fields/field_table.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame_meaning.hpp"
#include "io/mavlink/messages/position.hpp"
#include "runtime/planted_bug.hpp"

namespace godwit::executor {
namespace {

using io::mavlink::mav_cmd;
using io::mavlink::number;

// A position needs integers: a float has 1 m of latitude at best.
vehicle_link::send_command home_command() {
  vehicle_link::send_command command;
  command.command = number(mav_cmd::do_set_home);
  command.form = vehicle_link::command_form::in_integers;
  command.frame = number(io::mavlink::mav_frame::global);
  return command;
}

} // namespace

vehicle_link::send_command home_request() {
  vehicle_link::send_command command;
  command.command = number(mav_cmd::request_message);
  command.param1 = static_cast<float>(io::mavlink::home_position::message_id);
  return command;
}

std::string task_runner::what_is_asked() const {
  const auto& what = way_[at_];
  if (const auto* mode = std::get_if<change_mode>(&what))
    return "to change to " + std::string(io::name_of(mode->to));
  if (const auto* item = std::get_if<set_current_item>(&what))
    return "to go to item " + std::to_string(item->sequence);
  if (std::holds_alternative<stand_by>(what))
    return "to leave its mission mode on the ground";
  if (std::holds_alternative<await_arming>(what))
    return "to change to its mission mode on the ground";
  if (std::holds_alternative<set_home>(what) || std::holds_alternative<see_home>(what))
    return "to have its home where the mission began";
  if (std::holds_alternative<free_home>(what))
    return "to have its home where it stands";
  if (std::holds_alternative<arm>(what))
    return "to arm";
  if (std::holds_alternative<disarm>(what))
    return "to disarm";
  if (std::holds_alternative<guard>(what))
    return "to be guarded";
  if (std::holds_alternative<clear_plan>(what))
    return "to drop the plan that it can not fly";
  return std::holds_alternative<bring_plan>(what) ? "to take the plan" : "to start the mission";
}

void task_runner::ask(const world& w, const change_mode& what) { ask_for_mode(w, what.to); }

void task_runner::ask(const world& w, const await_arming&) { ask_for_mode(w, flight::mode_kind::mission); }

void task_runner::ask_for_mode(const world& w, flight::mode_kind to) {
  const auto command = flight::mode_command(w.view.owner(), to);
  if (!command)
    return fail("this vehicle has no mode " + std::string(io::name_of(to)));
  expect(w, flight::modes_obeying(w.view.owner(), to));
  give_order(w, *command);
}

void task_runner::ask(const world& w, const stand_by&) {
  const auto mode = flight::standing_mode(w.view.owner());
  if (!mode)
    return fail("this vehicle has no mode in which it stands");
  expect(w, {*mode});
  give_order(w, flight::mode_command(w.view.owner(), *mode));
}

// The plan and the failsafe count heights from the same place, the vehicle's home.
void task_runner::ask(const world& w, const guard&) {
  if (auto modes = announced_modes(task_->kind, way_, at_, w.view.owner()); !modes.empty())
    w.out.emplace_back(
        say_to_failsafe{failsafe::expect_mode{std::move(modes), flight::order_is_expected_ns / 1'000'000}});
  failsafe::guard_mission limits;
  if (w.durable.flown) {
    if (w.durable.progress.last_generation == 0 || !GODWIT_PLANTED(forget_fence_revision))
      limits.geofences = w.durable.flown->mission.geofences;
    limits.land_start = w.durable.flown->landing_sequence;
    limits.plan_end = end_of_plan(w.view.owner(), w.durable);
    limits.home_before = w.durable.flown->home;
  }
  if (w.durable.home && w.durable.home->is_resolved)
    limits.home = w.durable.home->at;
  w.out.emplace_back(order{urgency(), ++last_order_, w.now_ns, std::exchange(expected_, {}), std::move(limits)});
}

// No items: the vehicle's plan is cleared.
void task_runner::ask(const world& w, const clear_plan&) {
  w.out.emplace_back(order{urgency(), ++last_order_, w.now_ns, std::exchange(expected_, {}),
                           vehicle_link::upload_plan{io::mavlink::mav_mission_type::mission, {}, known(w)}});
}

void task_runner::ask(const world& w, const bring_plan&) {
  if (tries_ == 1)
    uploads_.begin(w.now_ns);
  held_infeasible_ = w.view.finds_infeasible();
  w.seen.plan.forget();
  w.out.emplace_back(
      order{urgency(), ++last_order_, w.now_ns, std::exchange(expected_, {}),
            vehicle_link::upload_plan{io::mavlink::mav_mission_type::mission, w.durable.brings->items, known(w)}});
}

void task_runner::ask(const world& w, const set_current_item& what) {
  w.out.emplace_back(order{urgency(), ++last_order_, w.now_ns, std::exchange(expected_, {}),
                           vehicle_link::set_current_item{what.anew ? std::uint16_t{0} : what.sequence, known(w)}});
}

void task_runner::ask(const world& w, const set_home&) {
  if (!w.durable.home)
    return fail("where home was at the first take-off is not known");
  constexpr double units = io::mavlink::units_of(io::mavlink::coordinate_kind::global);
  auto command = home_command();
  command.x = static_cast<std::int32_t>(std::lround(w.durable.home->at.latitude * units));
  command.y = static_cast<std::int32_t>(std::lround(w.durable.home->at.longitude * units));
  command.z = static_cast<float>(w.durable.home->at.above_sea_m);
  give_order(w, command);
}

void task_runner::ask(const world& w, const see_home&) { give_order(w, home_request()); }

void task_runner::ask(const world& w, const free_home&) {
  auto command = home_command();
  command.param1 = 1; // where it stands
  give_order(w, command);
}

void task_runner::ask(const world& w, const arm&) {
  vehicle_link::send_command command;
  command.command = number(mav_cmd::component_arm_disarm);
  command.param1 = 1;
  armed_ns_ = w.now_ns;
  give_order(w, command);
}

// Without force: what flies stays armed.
void task_runner::ask(const world& w, const disarm&) {
  vehicle_link::send_command command;
  command.command = number(mav_cmd::component_arm_disarm);
  give_order(w, command);
}

// All items: ArduPilot denies other values, and the plan, or the item that was chosen, says where it begins. A vehicle
// by the text alone is told. A PX4 is started by its mission mode: MISSION_START arms a vehicle that a person has just
// disarmed.
void task_runner::ask(const world& w, const start_plan& what) {
  vehicle_link::send_command command;
  command.command = number(mav_cmd::mission_start);
  const auto autopilot = w.view.owner().autopilot;
  if (autopilot == io::mavlink::mav_autopilot::px4)
    command = *flight::mode_command(w.view.owner(), flight::mode_kind::mission);
  else if (autopilot != io::mavlink::mav_autopilot::ardupilotmega)
    command.param1 = static_cast<float>(what.sequence);
  expect(w, flight::modes_of_start(w.view.owner()));
  give_order(w, command);
}

// The look counts for the order that it was made for.
std::optional<vehicle_link::seen_state> task_runner::known(const world& w) const {
  auto result = w.known;
  if (result && is_moving_)
    result->looked_ns = looked_ns_;
  return result;
}

// Also told to the failsafe, with the command.
void task_runner::expect(const world& w, std::vector<std::uint32_t> modes) {
  last_expected_ = modes;
  if (is_stop()) { // it may have given up another order, which still comes through
    std::erase_if(last_expected_, [&](auto each) { return w.authority.expects({{}, each}, w.now_ns); });
    w.authority.expect_also(modes, w.now_ns, w.now_ns + flight::order_is_expected_ns);
  } else {
    w.authority.expect(modes, w.now_ns + flight::order_is_expected_ns);
  }
  expected_ = std::move(modes);
}

void task_runner::give_order(const world& w, vehicle_link::send_command what) {
  what.confirmation = static_cast<std::uint8_t>(tries_ - 1);
  if (is_stop())
    what.timeout_ms = stop_answer_ms;
  if (is_moving_)
    what.copies = vehicle_link::copies_of_moving_order;
  what.only_while = known(w);
  w.out.emplace_back(order{urgency(), ++last_order_, w.now_ns, std::exchange(expected_, {}), what});
}

} // namespace godwit::executor
