#include "actors/ground_port/actor.hpp"

#include <algorithm>
#include <chrono>
#include <type_traits>

namespace godwit::ground_port {

namespace {

std::string sentence_for(runtime::ask_errc why) {
  switch (why) {
  case runtime::ask_errc::timeout:
    return "the executor does not answer";
  case runtime::ask_errc::not_taken:
    return "the executor is not running";
  case runtime::ask_errc::outcome_unknown:
  case runtime::ask_errc::given_up:
    break;
  }
  return "the executor failed; try again";
}

} // namespace

template <class M>
auto actor::hears() {
  return on<M>([this](const M& message) { then(core_->on_telemetry(message, now())); });
}

actor::actor(runtime::spawn_context context, settings configured, signing_settings signing, std::shared_ptr<wire> line,
             std::shared_ptr<const peers> others)
    : line_actor(std::move(context), std::move(line)), settings_(std::move(configured)), signing_(std::move(signing)),
      others_(std::move(others)) {}

actor::~actor() = default;

actor::behavior_type actor::handlers() {
  return {
      on<executor::start_answer>([this](const executor::start_answer& m) { then(core_->on_start_answer(m, now())); }),
      on<mission_progress>([this](const mission_progress& m) { then(core_->on_progress(m, now())); }),
      on<item_reached>([this](const item_reached& m) { then(core_->on_item_reached(m, now())); }),
      on<status_text>([this](const status_text& m) { then(core_->on_status_text(m, now())); }),
      on<plan_judged>([this](const plan_judged& m) { then(core_->on_plan_judged(m, now())); }),
      on<executor::act_resolved>([this](const executor::act_resolved& m) { then(core_->on_act_resolved(m, now())); }),
      on<operator_bridge::control_news>(
          [this](const operator_bridge::control_news& m) { then(core_->on_control(m, now())); }),
      on<set_mission>([this](const set_mission& m) { then(core_->on_set_mission(m, now())); }),
      on<get_port>([this](const get_port&) {
        auto result = core_->describe(now());
        const auto lost = drops();
        result.counts.push_back({"dropped_in", lost.in});
        result.counts.push_back({"dropped_out", lost.out});
        return result;
      }),
      on<vehicle_link::relayed_frame>(
          [this](const vehicle_link::relayed_frame& m) { then(core_->on_relayed(m, now())); }),
      hears<mavlink::heartbeat>(),
      hears<mavlink::sys_status>(),
      hears<mavlink::system_time>(),
      hears<mavlink::gps_raw_int>(),
      hears<mavlink::attitude>(),
      hears<mavlink::global_position_int>(),
      hears<mavlink::mission_current>(),
      hears<mavlink::mission_item_reached>(),
      hears<mavlink::vfr_hud>(),
      hears<mavlink::battery_status>(),
      hears<mavlink::autopilot_version>(),
      hears<mavlink::fence_status>(),
      hears<mavlink::home_position>(),
      hears<mavlink::extended_sys_state>(),
      hears<mavlink::statustext>(),
      on<wake>([this](const wake&) { drain(); })};
}

void actor::started() {
  core_.emplace(settings_, signing_, current_state(), others_->executor.has_value(), now());
  begin_line();
  ask_who_has_control();
}

// -- effects --------------------------------------------------------------------------------------

void actor::execute(const effects& wanted) {
  for (const auto& each : wanted)
    std::visit([this](const auto& what) { execute(what); }, each);
}

void actor::execute(const start_request_to_executor& each) {
  ask(
      *others_->executor, current_patience, each.what,
      [this, request = each.request](const executor::current_answer& answer) {
        then(core_->on_current_answer(request, answer, now()));
      },
      [this, request = each.request](const runtime::ask_error& why) {
        then(core_->on_current_failed(request, sentence_for(why.code), now()));
      });
}

void actor::execute(const word_to_say& each) {
  ask(
      *others_->executor, command_patience, each.what,
      [this, request = each.request](const operators::answer& answer) {
        then(core_->on_word_answer(request, answer, now()));
      },
      [this, request = each.request](const runtime::ask_error& why) {
        then(core_->on_word_failed(request, sentence_for(why.code), now()));
      });
}

void actor::execute(const pass_on& each) {
  if (others_->vehicle)
    tell(*others_->vehicle, each.what);
}

void actor::execute(const act_to_ask& each) {
  ask(
      *others_->executor, act_patience, each.what,
      [this, request = each.request](const executor::act_answer& answer) {
        then(core_->on_act_answer(request, answer, now()));
      },
      [this, request = each.request](const runtime::ask_error& why) {
        then(core_->on_act_failed(request, sentence_for(why.code), now()));
      });
}

void actor::execute(const acknowledgement_to_tell& each) {
  if (others_->executor)
    tell(*others_->executor, each.what);
}

void actor::execute(const tell_taken_over&) {
  if (others_->failsafe)
    tell(*others_->failsafe, failsafe::taken_over{});
}

void actor::execute(const audit_row_to_tell& each) {
  if (!others_->bridge)
    return;
  const auto name = "station " + std::to_string(each.who.system) + '/' + std::to_string(each.who.component);
  const auto role = settings_.stations_are.value_or(operators::role::viewer);
  // What is refused to one that nobody can tell from a stranger is a stranger's row: they fill nobody else's.
  const bool is_stranger = !signing_.key && each.outcome != "taken";
  tell(*others_->bridge,
       operator_bridge::audit_note{
           {name, role, is_stranger ? std::string() : "mavlink"}, each.what, each.outcome, each.reason});
}

// Until it is known stations hold and return, and no more. Whoever is started later tells it by itself.
void actor::ask_who_has_control() {
  if (!others_->bridge || !settings_.stations_are)
    return;
  ask(
      *others_->bridge, control_patience, operator_bridge::get_operators{},
      [this](const operator_bridge::operators_view& m) {
        if (!core_->knows_control()) // what was told since is newer
          then(core_->on_control({m.control ? m.control->who.name : std::string()}, now()));
      },
      [this](const runtime::ask_error& why) {
        if (why.code == runtime::ask_errc::timeout && !core_->knows_control())
          ask_who_has_control();
      });
}

void actor::execute(const operator_link& each) {
  for (const auto& ear : others_->operator_ears)
    tell(ear, each);
}

void actor::dispatch(const durable_core::effect& each) {
  std::visit(
      [this]<class M>(const M& m) {
        if constexpr (std::is_same_v<M, signing_time_reserved>) {
          core_->on_reserved(mavlink::signing_time{m.ceiling});
        } else if constexpr (runtime::accepts<executor::station_handle, M>) {
          if (others_->executor)
            tell(*others_->executor, m);
        } else {
          then(core_->on_durable(m, now()));
        }
      },
      each);
}

} // namespace godwit::ground_port
