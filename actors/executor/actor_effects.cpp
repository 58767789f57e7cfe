// How what the cores decided leaves the executor: orders to the vehicle, and what is said to other actors.
#include <algorithm>
#include <type_traits>
#include <utility>

#include "actors/executor/actor.hpp"
#include "actors/executor/station_plan.hpp"
#include "runtime/planted_bug.hpp"

namespace godwit::executor {

namespace {

// QGroundControl takes a text that begins with this word for a check that has failed, and shows so in a banner.
std::string for_stations(const std::string& sentence, io::mavlink::mav_severity severity) {
  constexpr std::string_view word = "preflight: ";
  const bool has_failed = severity <= io::mavlink::mav_severity::warning;
  return has_failed || !sentence.starts_with(word) ? sentence : sentence.substr(word.size());
}

} // namespace

void actor::execute(const effects& wanted) {
  for (const auto& each : wanted)
    std::visit([this](const auto& what) { execute(what); }, each);
  core_->on_applied();
}

void actor::execute(const order& each) {
  if (each.when == goes::at_once || GODWIT_PLANTED(forget_gate))
    send(each);
  else
    after_commit([this, each] { dispatch_effect(each); });
}

void actor::dispatch_effect(const order& each) {
  switch (core_->lets_out(each, now())) {
  case core::release::now:
    send(each);
    break;
  case core::release::outdated:
    at_end([this, each] { then(core_->on_outdated(each, now())); });
    break;
  case core::release::too_late:
    at_end([this, each] { then(core_->on_late(each, now())); });
    break;
  case core::release::pending:
    at_end([this, each] { then(core_->on_pending(each, now())); });
    break;
  case core::release::revoked:
    ++revoked_;
    at_end([this, each] { then(core_->on_revoked(each)); });
    world_.tell_people({"an order that waited for the disk is not sent any more", true});
    break;
  }
}

void actor::send(const order& each) {
  if (!each.expected.empty())
    tell(others_->failsafe, failsafe::expect_mode{each.expected, flight::order_is_expected_ns / 1'000'000});
  std::visit([&](const auto& what) { send(each.number, what); }, each.what);
}

template <class Q>
void actor::command_vehicle(std::uint64_t number, const Q& what) {
  ask(
      others_->vehicle, command_patience, what,
      [this, number](const vehicle_link::command_outcome& outcome) { then(core_->on_command(number, outcome, now())); },
      [this, number](const runtime::ask_error&) {
        vehicle_link::command_outcome outcome;
        outcome.verdict = vehicle_link::command_verdict::timed_out;
        outcome.reason = "vehicle_link did not answer";
        then(core_->on_command(number, outcome, now()));
      });
}

void actor::send(std::uint64_t number, const vehicle_link::send_command& what) { command_vehicle(number, what); }

void actor::send(std::uint64_t number, const vehicle_link::set_current_item& what) { command_vehicle(number, what); }

void actor::send(std::uint64_t number, const vehicle_link::look& what) {
  ask(
      others_->vehicle, look_patience, what,
      [this, number](const vehicle_link::looked& seen) { then(core_->on_looked(number, seen, now())); },
      [this, number](const runtime::ask_error&) {
        then(core_->on_looked(number, {false, 0, "vehicle_link did not answer"}, now()));
      });
}

void actor::send(std::uint64_t number, const failsafe::guard_mission& what) {
  ask(
      others_->failsafe, failsafe_status_patience, what,
      [this, number](const failsafe::guard_answer& answer) { then(core_->on_guarded(number, answer, true, now())); },
      [this, number](const runtime::ask_error&) {
        then(core_->on_guarded(number, {false, "it does not answer"}, false, now()));
      });
}

template <class Q>
void actor::transfer_plan(std::uint64_t number, const Q& what) {
  ask(
      others_->vehicle, transfer_patience, what,
      [this, number](const vehicle_link::transfer::outcome& outcome) {
        then(core_->on_transfer(number, outcome, now()));
      },
      [this, number](const runtime::ask_error&) {
        vehicle_link::transfer::outcome outcome; // timed out; what the vehicle holds is not known
        outcome.reason = "vehicle_link did not answer";
        then(core_->on_transfer(number, outcome, now()));
      });
}

void actor::execute(const give_up_transfer&) { tell(others_->vehicle, vehicle_link::cancel_transfer{}); }

void actor::execute(const watch_vehicle& each) { tell(others_->vehicle, vehicle_link::watch_closely{each.is_close}); }

void actor::execute(const send_to_failsafe& each) {
  std::visit([this](const auto& what) { tell(others_->failsafe, what); }, each.what);
}

void actor::execute(const send_to_client& each) {
  if (others_->client)
    after_commit([this, each] { std::visit([this](const auto& what) { tell(*others_->client, what); }, each.what); });
}

void actor::execute(const send_to_port& each) {
  if (others_->port)
    std::visit([this](const auto& what) { tell(*others_->port, what); }, each.what);
}

void actor::execute(const announce& each) {
  using io::mavlink::mav_severity;
  at_end([this, each] { world_.tell_people(each); });
  if (!each.is_vehicles)
    send_to_stations(each.is_warning ? mav_severity::warning : mav_severity::info, each.sentence);
}

void actor::send_to_stations(io::mavlink::mav_severity severity, const std::string& sentence) {
  if (others_->port)
    tell(*others_->port, ground_port::status_text{severity, for_stations(sentence, severity)});
}

void actor::show_reached(const mission::progress_report& report) {
  auto reached = reached_shown(current_state(), report, settings_.shows_home);
  if (!others_->port || !reached)
    return;
  const auto before = std::ranges::find(restored_missions_, report.mission_id, &progress::mission_record::mission_id);
  reached->is_repeated = before != restored_missions_.end() && report.report_no <= before->report_no;
  tell(*others_->port, *std::move(reached));
}

void actor::show_phase_status(const phase_status& status) {
  using io::mavlink::mav_severity;
  at_end([this, status] {
    world_.on_phase_status(status);
    auto sentence = core_->sentence();
    if (sentence == told_phase_)
      return;
    send_to_stations(status.now == phase::paused ? mav_severity::warning : mav_severity::info, sentence);
    told_phase_ = std::move(sentence);
  });
}

void actor::show_missions() {
  if (others_->viewers.empty())
    return;
  auto known = core_->missions();
  if (shown_missions_ == known)
    return;
  for (const auto& each : others_->viewers)
    tell(each, known);
  shown_missions_ = std::move(known);
}

// Each time, also when it is as before: who shows it says how old it is.
void actor::show_way_home() {
  for (const auto& each : others_->viewers)
    tell(each, core_->way_home(now()));
}

// While there is any, and once when there is none any more.
void actor::show_traffic() {
  const auto at_ns = now().now_ns;
  if (others_->viewers.empty() || at_ns - traffic_shown_ns_ < traffic_period_ns)
    return;
  const auto seen = core_->traffic(now());
  const bool is_any = !seen.aircraft.empty() || !seen.warnings.empty();
  if (!is_any && !std::exchange(shows_traffic_, false))
    return;
  shows_traffic_ = is_any;
  traffic_shown_ns_ = at_ns;
  for (const auto& each : others_->viewers)
    tell(each, seen);
}

namespace {

template <class M>
const std::string& mission_of(const M& m) {
  if constexpr (std::is_same_v<M, mission_client::report_progress>)
    return m.report.mission_id;
  else
    return m.mission_id;
}

} // namespace

void actor::dispatch(const durable_core::effect& each) {
  std::visit(
      [this]<class M>(const M& m) {
        if constexpr (std::is_same_v<M, mission_client::report_progress> ||
                      std::is_same_v<M, mission_client::respond_to_assignment> ||
                      std::is_same_v<M, mission_client::insert_waypoint> ||
                      std::is_same_v<M, mission_client::replace_tail>) {
          if (others_->client && core_->is_of_service(mission_of(m)))
            tell(*others_->client, m);
          if constexpr (std::is_same_v<M, mission_client::report_progress>)
            show_reached(m.report);
        } else if constexpr (std::is_same_v<M, start_answer>) {
          if (!answer_current(m) && others_->port)
            tell(*others_->port, m);
        } else if constexpr (std::is_same_v<M, ground_port::plan_judged>) {
          execute(send_to_port{m});
        } else if constexpr (std::is_same_v<M, phase_status>) {
          show_phase_status(m);
        } else if constexpr (std::is_same_v<M, preflight::phase_changed>) {
          execute(announce{"preflight: " + m.sentence, m.now == preflight::phase::failed});
        } else if constexpr (std::is_same_v<M, preflight::report_opened>) {
          execute(announce{"preflight report " + std::to_string(m.what.id) + " waits for an acknowledgement", true});
        } else if constexpr (std::is_same_v<M, preflight::acknowledgement_answered>) {
          if (!m.is_taken)
            execute(announce{"the acknowledgement is not taken: " + m.reason, true});
        } else {
          news_.push_back(m);
        }
      },
      each);
}

} // namespace godwit::executor
