#include "actors/executor/tasks/step_rules.hpp"

#include <cmath>
#include <utility>

#include "actors/domain/control_authority/mode_tables.hpp"
#include "actors/domain/home/home.hpp"
#include "actors/executor/plan/vehicle_items.hpp"
#include "actors/executor/remaining.hpp"
#include "io/fields/field_table.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame_meaning.hpp"
#include "io/mavlink/messages/position.hpp"
#include "runtime/planted_bug.hpp"

namespace godwit::executor {
namespace {

using flight::mode_kind;
using io::mavlink::mav_cmd;
using io::mavlink::number;
using request = tl::expected<step_request, std::string>;

constexpr const char* is_disarmed = "the vehicle is disarmed";
constexpr const char* was_armed = "it was armed meanwhile";

// A step whose block below does not say otherwise.
struct any_step {
  static constexpr step_intent intent = step_intent::none;
  template <class Step>
  static std::string why_not_now(const Step&, const step_context&) {
    return {};
  }
  template <class Step>
  static step_effect effect(const Step&, const step_context&) {
    return step_effect::neutral;
  }
  template <class Step>
  static bool is_done(const Step&, const step_context&) {
    return false;
  }
  template <class Step>
  static bool is_done_by_answer(const Step&, const step_context&) {
    return false;
  }
};

template <class Step>
struct rules_of;

bool flies_mission(const step_context& c) { return c.view.is_armed() && c.view.is_in(mode_kind::mission); }

// Somebody has stopped its motors, or its flight is about to end: the plan of a flight has nothing to do there.
std::string why_not_in_flight(const step_context& c) {
  return c.durable.status.in_flight && !c.view.is_armed() ? is_disarmed : "";
}

bool is_answered(const step_context& c) { return c.attempts.tries > 0 && c.attempts.was_accepted; }

request mode_request(const step_context& c, mode_kind to) {
  const auto command = flight::mode_command(c.view.owner(), to);
  if (!command)
    return tl::unexpected("this vehicle has no mode " + std::string(io::name_of(to)));
  return step_request{flight::modes_obeying(c.view.owner(), to), *command};
}

request plan_request(std::vector<io::mavlink::mission_item_int> items) {
  return step_request{{}, vehicle_link::upload_plan{io::mavlink::mav_mission_type::mission, std::move(items)}};
}

// A position needs integers: a float has 1 m of latitude at best.
vehicle_link::send_command home_command() {
  vehicle_link::send_command command;
  command.command = number(mav_cmd::do_set_home);
  command.form = vehicle_link::command_form::in_integers;
  command.frame = number(io::mavlink::mav_frame::global);
  return command;
}

vehicle_link::send_command arming_command(bool is_armed) {
  vehicle_link::send_command command;
  command.command = number(mav_cmd::component_arm_disarm);
  command.param1 = is_armed ? 1 : 0; // without force: what flies stays armed
  return command;
}

// -- modes ------------------------------------------------------------------------------------------

template <>
struct rules_of<change_mode> : any_step {
  static std::string description(const change_mode& what) {
    return "to change to " + std::string(io::name_of(what.to));
  }
  static std::string why_not_now(const change_mode& what, const step_context& c) {
    const bool lets_fly_on = what.to == mode_kind::mission || what.to == mode_kind::guided;
    const bool goes_on = lets_fly_on && c.kind != task_kind::start && !is_stop(c.kind, nullptr);
    return goes_on && !c.view.is_armed() ? is_disarmed : "";
  }
  static step_effect effect(const change_mode& what, const step_context& c) {
    if (what.to == mode_kind::mission)
      return step_effect::flies_plan;
    if (what.to == mode_kind::hold && c.kind == task_kind::deploy)
      return step_effect::holds;
    return what.to == mode_kind::guided || what.to == mode_kind::returning ? step_effect::moves : step_effect::neutral;
  }
  static request send(const change_mode& what, const step_context& c) { return mode_request(c, what.to); }
  static bool is_done(const change_mode& what, const step_context& c) {
    const auto& sent = c.attempts;
    return c.view.obeys(what.to) && (sent.tries == 0 ? !sent.must_ask : c.view.heartbeats() > sent.sent_at_heartbeat);
  }
};

template <>
struct rules_of<safe_ground_mode> : any_step {
  static std::string description(const safe_ground_mode&) { return "to leave its mission mode on the ground"; }
  static std::string why_not_now(const safe_ground_mode& what, const step_context& c) {
    return !what.is_armed && c.view.is_armed() ? was_armed : "";
  }
  static step_effect effect(const safe_ground_mode&, const step_context&) { return step_effect::stops; }
  static request send(const safe_ground_mode&, const step_context& c) {
    const auto mode = flight::standing_mode(c.view.owner());
    if (!mode)
      return tl::unexpected(std::string("this vehicle has no mode in which it stands"));
    return step_request{std::vector{*mode}, flight::mode_command(c.view.owner(), *mode)};
  }
  static bool is_done(const safe_ground_mode&, const step_context& c) {
    const auto mode = flight::standing_mode(c.view.owner());
    return mode && c.view.is_in_one_of({*mode});
  }
};

template <>
struct rules_of<await_arming> : any_step {
  static std::string description(const await_arming&) { return "to change to its mission mode on the ground"; }
  static std::string why_not_now(const await_arming&, const step_context& c) {
    return c.view.is_armed() ? was_armed : "";
  }
  static step_effect effect(const await_arming&, const step_context&) { return step_effect::flies_plan; }
  static request send(const await_arming&, const step_context& c) { return mode_request(c, mode_kind::mission); }
  static bool is_done(const await_arming&, const step_context& c) {
    return c.view.is_in(mode_kind::mission) && !c.view.is_armed();
  }
};

// -- the failsafe and the plan on the vehicle --------------------------------------------------------

// The plan and the failsafe count heights from the same place, the vehicle's home.
template <>
struct rules_of<guard> : any_step {
  static std::string description(const guard&) { return "to be guarded"; }
  static request send(const guard&, const step_context& c) {
    failsafe::guard_mission limits;
    if (c.durable.flown) {
      if (c.durable.progress.last_generation == 0 || !GODWIT_PLANTED(forget_fence_revision))
        limits.geofences = c.durable.flown->mission.geofences;
      limits.land_start = c.durable.flown->landing_sequence;
      limits.plan_end = end_of_plan(c.view.owner(), c.durable);
      limits.home_before = c.durable.flown->home;
    }
    if (c.durable.home && c.durable.home->is_resolved)
      limits.home = c.durable.home->at;
    return step_request{{}, std::move(limits)};
  }
};

template <>
struct rules_of<clear_plan> : any_step {
  static std::string description(const clear_plan&) { return "to drop the plan that it can not fly"; }
  static std::string why_not_now(const clear_plan&, const step_context& c) {
    return c.view.is_armed() ? was_armed : "";
  }
  static request send(const clear_plan&, const step_context&) { return plan_request({}); }
};

template <>
struct rules_of<upload_plan> : any_step {
  static constexpr step_intent intent = step_intent::upload;
  static std::string description(const upload_plan&) { return "to take the plan"; }
  static std::string why_not_now(const upload_plan&, const step_context& c) { return why_not_in_flight(c); }
  static step_effect effect(const upload_plan&, const step_context& c) { // PX4 flies it at once
    return flies_mission(c) && c.durable.status.in_flight ? step_effect::moves : step_effect::neutral;
  }
  static request send(const upload_plan&, const step_context& c) { return plan_request(c.durable.brings->items); }
};

template <>
struct rules_of<set_current_item> : any_step {
  static constexpr step_intent intent = step_intent::start;
  static std::string description(const set_current_item& what) {
    return "to go to item " + std::to_string(what.sequence);
  }
  static std::string why_not_now(const set_current_item&, const step_context& c) { return why_not_in_flight(c); }
  static step_effect effect(const set_current_item&, const step_context& c) { // else it only says where to go on
    return flies_mission(c) ? step_effect::flies_plan : step_effect::neutral;
  }
  static request send(const set_current_item& what, const step_context&) {
    return step_request{{}, vehicle_link::set_current_item{what.anew ? std::uint16_t{0} : what.sequence}};
  }
  static bool is_done(const set_current_item& what, const step_context& c) {
    const auto& current = c.view.current();
    return c.attempts.tries > 0 && current && c.view.current_heard_ns() > c.attempts.sent_ns &&
           current->seq >= (what.anew ? 0 : what.sequence) &&
           (what.total == 0 || current->total == 0 || current->total == what.total);
  }
  static bool is_done_by_answer(const set_current_item&, const step_context& c) {
    return c.view.is_in(mode_kind::mission);
  }
};

// -- home -------------------------------------------------------------------------------------------

template <>
struct rules_of<restore_home> : any_step {
  static std::string description(const restore_home&) { return "to have its home where the mission began"; }
  static request send(const restore_home&, const step_context& c) {
    if (!c.durable.home)
      return tl::unexpected(std::string("where home was at the first take-off is not known"));
    const auto& at = c.durable.home->at;
    constexpr double units = io::mavlink::units_of(io::mavlink::coordinate_kind::global);
    auto command = home_command();
    command.x = static_cast<std::int32_t>(std::lround(at.latitude * units));
    command.y = static_cast<std::int32_t>(std::lround(at.longitude * units));
    command.z = static_cast<float>(at.above_sea_m);
    return step_request{{}, command};
  }
  static bool is_done(const restore_home&, const step_context& c) { return is_answered(c); }
};

template <>
struct rules_of<confirm_home> : any_step {
  static std::string description(const confirm_home&) { return "to have its home where the mission began"; }
  static request send(const confirm_home&, const step_context&) { return step_request{{}, home_request()}; }
  static bool is_done(const confirm_home&, const step_context& c) {
    return c.attempts.tries > 0 && c.view.home_heard_ns() > c.attempts.sent_ns && c.durable.home &&
           flight::is_same_home(plan::place_of(*c.view.home()), c.durable.home->at);
  }
};

template <>
struct rules_of<reset_home> : any_step {
  static std::string description(const reset_home&) { return "to have its home where it stands"; }
  static request send(const reset_home&, const step_context&) {
    auto command = home_command();
    command.param1 = 1; // where it stands
    return step_request{{}, command};
  }
  static bool is_done(const reset_home&, const step_context& c) { return is_answered(c); }
};

// -- arming and starting ----------------------------------------------------------------------------

template <>
struct rules_of<arm> : any_step {
  static std::string description(const arm&) { return "to arm"; }
  static step_effect effect(const arm&, const step_context&) { return step_effect::flies_plan; }
  static request send(const arm&, const step_context&) { return step_request{{}, arming_command(true)}; }
  static bool is_done(const arm&, const step_context& c) { return c.view.is_armed(); }
};

// Somebody else may have it by now, or it may fly: as for what moves it, an observation comes first, and it is sent
// once.
template <>
struct rules_of<disarm> : any_step {
  static std::string description(const disarm&) { return "to disarm"; }
  static std::string why_not_now(const disarm&, const step_context& c) {
    if (c.view.is_moving() || c.view.is_in(mode_kind::mission))
      return "it moves, or is in its mission mode";
    return c.is_armed_by_us ? ""
                            : "it was not heard throughout since it was armed, and somebody else may have armed it";
  }
  static step_effect effect(const disarm&, const step_context&) { return step_effect::moves; }
  static request send(const disarm&, const step_context&) { return step_request{{}, arming_command(false)}; }
  static bool is_done(const disarm&, const step_context& c) { return !c.view.is_armed(); }
};

// A vehicle that was in its mission mode before (a rover that holds there) shows by its mission alone that a start
// whose answer was lost came through. One that was there already, at the only item of its plan, is through with it
// before it was seen in its mode.
bool is_start_shown(const step_context& c) {
  using io::mavlink::mission_state;
  const auto& current = c.view.current();
  const auto is_reported = [&](mission_state state) {
    return current && c.view.current_heard_ns() > c.attempts.sent_ns && current->mission_state == number(state);
  };
  if (!flies_mission(c))
    return c.attempts.was_accepted && c.view.is_armed() && is_reported(mission_state::complete);
  return !c.attempts.was_in_mission || c.attempts.was_accepted || is_reported(mission_state::active);
}

template <>
struct rules_of<start_plan> : any_step {
  static constexpr step_intent intent = step_intent::start;
  static std::string description(const start_plan&) { return "to start the mission"; }
  static std::string why_not_now(const start_plan&, const step_context& c) {
    return c.view.is_armed() ? "" : is_disarmed;
  }
  static step_effect effect(const start_plan&, const step_context&) { return step_effect::flies_plan; }
  // All items: ArduPilot denies other values, and the plan, or the item that was chosen, says where it begins. A
  // vehicle by the text alone gets the item. A PX4 is started by its mission mode: MISSION_START arms a vehicle that a
  // person has just disarmed.
  static request send(const start_plan& what, const step_context& c) {
    vehicle_link::send_command command;
    command.command = number(mav_cmd::mission_start);
    const auto& owner = c.view.owner();
    if (owner.autopilot == io::mavlink::mav_autopilot::px4)
      command = *flight::mode_command(owner, mode_kind::mission);
    else if (owner.autopilot != io::mavlink::mav_autopilot::ardupilotmega)
      command.param1 = static_cast<float>(what.sequence);
    return step_request{flight::modes_of_start(owner), command};
  }
  // A plan that begins with its end may be there before it was seen in its mode.
  static bool is_done(const start_plan&, const step_context& c) {
    const bool is_at_end = is_answered(c) && c.authority.who() == flight::holder::autopilot_end;
    return c.attempts.tries > 0 && (is_start_shown(c) || (c.view.is_armed() && is_at_end));
  }
};

template <class Step>
using rules = rules_of<std::decay_t<Step>>;

} // namespace

goes urgency_of(task_kind kind, const step* what) {
  const auto* mode = std::get_if<change_mode>(what);
  if (kind == task_kind::come_home_by_plan && mode != nullptr && mode->to == mode_kind::hold)
    return goes::at_once;
  return kind == task_kind::hold || kind == task_kind::come_home || kind == task_kind::stand_down ? goes::at_once
                                                                                                  : goes::after_notes;
}

bool is_stop(task_kind kind, const step* what) {
  return urgency_of(kind, what) == goes::at_once && kind != task_kind::stand_down;
}

step_intent intent_of(const step& what) {
  return std::visit([](const auto& each) { return rules<decltype(each)>::intent; }, what);
}

std::string why_not_now(const step& what, const step_context& c) {
  return std::visit([&](const auto& each) { return std::string(rules<decltype(each)>::why_not_now(each, c)); }, what);
}

step_effect effect_of(const step& what, const step_context& c) {
  if (is_stop(c.kind, &what))
    return step_effect::stops;
  return std::visit([&](const auto& each) { return rules<decltype(each)>::effect(each, c); }, what);
}

tl::expected<step_request, std::string> request_of(const step& what, const step_context& c) {
  return std::visit([&](const auto& each) { return rules<decltype(each)>::send(each, c); }, what);
}

bool is_done(const step& what, const step_context& c) {
  return std::visit([&](const auto& each) { return rules<decltype(each)>::is_done(each, c); }, what);
}

bool is_done_by_answer(const step& what, const step_context& c) {
  return std::visit([&](const auto& each) { return rules<decltype(each)>::is_done_by_answer(each, c); }, what);
}

std::string description_of(const step& what) {
  return std::visit([](const auto& each) { return rules<decltype(each)>::description(each); }, what);
}

vehicle_link::send_command home_request() {
  vehicle_link::send_command command;
  command.command = number(mav_cmd::request_message);
  command.param1 = static_cast<float>(io::mavlink::home_position::message_id);
  return command;
}

} // namespace godwit::executor
