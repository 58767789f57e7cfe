#include "actors/health/actor.hpp"

#include <utility>

#include "io/time_units.hpp"
#include "runtime/health_board.hpp"

namespace godwit::health {
namespace {

colour colour_of(runtime::health_colour how) {
  switch (how) {
  case runtime::health_colour::green:
    return colour::green;
  case runtime::health_colour::yellow:
    return colour::yellow;
  case runtime::health_colour::red:
    break;
  }
  return colour::red;
}

} // namespace

actor::actor(runtime::spawn_context context, std::shared_ptr<const peers> others, outside_world world,
             std::shared_ptr<report_port> port)
    : actor_base(std::move(context)), others_(std::move(others)), world_(std::move(world)), port_(std::move(port)) {}

actor::~actor() = default;

actor::behavior_type actor::handlers() {
  return {on<get_health>([this](const get_health&) {
            look_at_board();
            return core_.status();
          }),
          on<make_report>([this](const make_report&) { collect(); })};
}

void actor::on_deadline() {
  look_at_board();
  wake_at(now_ns() + std::chrono::nanoseconds(look_period).count());
}

void actor::look_at_board() {
  board_view view;
  for (auto& each : outside().health->entries())
    view.all.push_back({std::move(each.component), colour_of(each.colour), std::move(each.reason)});
  observe(view, seen_);
  const bool is_news = core_.on_board(view.all, handler_time().wall_ns / ns_per_ms);
  if (is_news)
    note_call_with("show health", core_.status());
  if (is_news)
    for (const auto& each : others_->listeners)
      tell(each, core_.status());
  at_end([this, at_ns = handler_time().monotonic_ns] { port_->show(core_.status(), at_ns); });
}

template <class Handle, class Question, class Answer>
void actor::collect_part(const char* part, const Handle& who, Question question, std::optional<Answer> report::*where) {
  if (!who)
    return;
  ++missing_;
  ask(
      who, answer_timeout, question,
      [this, where](const Answer& answer) {
        half_.*where = answer;
        take_part();
      },
      [this, part](const runtime::ask_error& why) {
        half_.unanswered.push_back({part, why.what});
        take_part();
      });
}

void actor::collect_actors() {
  if (!others_->guardian)
    return;
  ++missing_;
  ask(
      others_->guardian, answer_timeout, runtime::get_children{},
      [this](const runtime::children& all) {
        half_.actors = all.list;
        take_part();
      },
      [this](const runtime::ask_error& why) {
        half_.unanswered.push_back({"actors", why.what});
        take_part();
      });
}

void actor::collect() {
  if (missing_ != 0)
    return;
  half_ = {};
  ++missing_; // itself, so that no answer ends it too early
  collect_actors();
  collect_part("flight", others_->flight, executor::get_flight{}, &report::flight);
  collect_part("missions", others_->missions, executor::get_missions{}, &report::missions);
  collect_part("traffic", others_->traffic, executor::get_traffic{}, &report::traffic);
  collect_part("failsafe", others_->failsafe, failsafe::get_failsafe_status{}, &report::failsafe);
  collect_part("vehicle", others_->vehicle, vehicle_link::get_connection{}, &report::vehicle);
  collect_part("ground", others_->ground, ground_port::get_port{}, &report::ground);
  collect_part("service", others_->service, mission_client::get_service{}, &report::service);
  collect_part("map", others_->map, mapobjects_store::get_map{}, &report::map);
  collect_part("fleet", others_->fleet, fleet_link::get_fleet{}, &report::fleet);
  take_part();
}

void actor::take_part() {
  if (--missing_ != 0)
    return;
  look_at_board();
  auto host = world_.read_host ? world_.read_host() : host_figures();
  half_.at_ms = handler_time().wall_ns / ns_per_ms;
  half_.health = core_.status();
  half_.mail = std::move(host.mail);
  half_.journal = std::move(host.journal);
  half_.trace = host.trace;
  half_.process = std::move(host.process);
  at_end([this, made = std::exchange(half_, {})] { port_->publish(made); });
}

} // namespace godwit::health
