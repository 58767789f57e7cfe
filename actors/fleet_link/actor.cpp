#include "actors/fleet_link/actor.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "actors/fleet_link/news.hpp"
#include "runtime/content_hash.hpp"
#include "runtime/overloaded.hpp"

namespace godwit::fleet_link {
namespace {

constexpr unsigned attempts_bits = 24; // of one incarnation

std::string hex(std::uint64_t number) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string result(16, '0');
  for (auto each = result.rbegin(); each != result.rend(); ++each, number >>= 4U)
    *each = digits[number & 15U];
  return result;
}

} // namespace

actor::actor(runtime::spawn_context context, settings configured, std::shared_ptr<const peers> others,
             std::shared_ptr<broker_port> port, std::uint64_t process)
    : durable_actor(std::move(context)), others_(std::move(others)), port_(std::move(port)), process_(hex(process)),
      core_(std::move(configured), process ^ incarnation_number(), process_, incarnation_number() << attempts_bits) {}

actor::~actor() { port_->close(core_.attempt()); }

actor::behavior_type actor::handlers() {
  return {
      on<broker_opened>([this](const broker_opened& m) {
        execute(core_.on_opened(m, current_state(), now()));
        turn();
      }),
      on<broker_closed>([this](const broker_closed& m) {
        execute(core_.on_closed(m, now()));
        turn();
      }),
      on<event_taken>([this](const event_taken& m) {
        core_.on_taken(m);
        turn();
      }),
      on<text_left>([this](const text_left& m) { core_.on_left(m); }),
      on<get_fleet>([this](const get_fleet&) { return core_.view_of(current_state(), now()); }),
      on<scan_controller::point_shown>([this](const scan_controller::point_shown& m) { note(news_of(m)); }),
      on<scan_controller::point_closed>([this](const scan_controller::point_closed& m) { note(news_of(m)); }),
      on<executor::flight_status>([this](const executor::flight_status& m) { note(news_of(current_state().seen, m)); }),
      on<health::health_status>([this](const health::health_status& m) { note(news_of(current_state().seen, m)); }),
      on<failsafe::failsafe_status>(
          [this](const failsafe::failsafe_status& m) { note(news_of(current_state().seen, m)); })};
}

void actor::started() {
  if (others_->open_live)
    take_live_ = others_->open_live();
  if (current_state().store.empty())
    commit(store_named{process_});
  else
    after_commit([this, upto = current_state().next_number - 1] {
      core_.on_written(upto);
      turn();
    });
  note(news_of_process(current_state().seen, process_));
  ask_how_it_stands();
  turn();
}

// What was told while there was no incarnation to hear it.
void actor::ask_how_it_stands() {
  if (others_->flight)
    ask(
        others_->flight, answer_timeout, executor::get_flight{},
        [this](const executor::flight_status& m) { note(news_of(current_state().seen, m)); },
        [](const runtime::ask_error&) {}); // it tells the next change
  if (others_->failsafe)
    ask(
        others_->failsafe, answer_timeout, failsafe::get_failsafe_status{},
        [this](const failsafe::failsafe_status& m) { note(news_of(current_state().seen, m)); },
        [](const runtime::ask_error&) {}); // the same
}

void actor::look_at_actors() {
  if (!others_->guardian)
    return;
  ask(
      others_->guardian, answer_timeout, runtime::get_children{},
      [this](const runtime::children& m) { note(news_of(current_state().seen, m)); },
      [](const runtime::ask_error&) {}); // asked again
}

void actor::note(std::optional<noted> what) {
  if (!what)
    return;
  what->is_late = !core_.is_connected();
  commit(*what);
}

void actor::dispatch(const durable_core::effect& each) {
  core_.on_written(std::get<written>(each).upto);
  turn();
}

void actor::drain_stream() {
  if (!take_live_)
    return;
  if (!is_recorded()) {
    while (auto text = take_live_())
      core_.on_text(std::move(text));
    return;
  }
  const auto next = [this] {
    const auto text = take_live_();
    return text ? std::optional(live_text{*text}) : std::nullopt;
  };
  while (auto taken = take_beside<live_text>(next))
    core_.on_text(std::make_shared<const std::string>(std::move(taken->text)));
}

void actor::turn() {
  const auto at = now();
  if (at.monotonic_ns >= look_ns_) {
    look_at_actors();
    look_ns_ = at.monotonic_ns + look_period_ns;
  }
  drain_stream();
  if (const auto news = core_.newly_delivered(current_state()))
    commit(*news);
  execute(core_.turn(current_state(), at));
  show_health(core_.health(current_state()));
  const auto beat_ns = at.monotonic_ns + core::beat_ns;
  wake_at(core_.is_connected() ? beat_ns : std::max(beat_ns, std::min(core_.next_due_ns(), look_ns_)));
}

void actor::note_calls(const effects& all) {
  for (const auto& each : all)
    std::visit(runtime::overloaded{[this](const open_broker& how) {
                                     note_call("open broker, attempt " + std::to_string(how.attempt),
                                               runtime::content_hash(*how.will.payload));
                                   },
                                   [this](const close_broker& which) {
                                     note_call("close broker, attempt " + std::to_string(which.upto),
                                               runtime::empty_hash);
                                   },
                                   [this](const publish& what) {
                                     note_call("publish " + what.what.topic + ' ' + std::to_string(what.what.number),
                                               runtime::content_hash(*what.what.payload));
                                   },
                                   [](const announce&) {}},
               each);
}

void actor::execute(effects all) {
  if (is_recorded())
    note_calls(all);
  for (auto& each : all)
    std::visit(runtime::overloaded{
                   [this](open_broker& how) {
                     at_end([port = port_, how = std::move(how)] { port->open(how.attempt, how.will); });
                   },
                   [this](close_broker& which) { at_end([port = port_, which] { port->close(which.upto); }); },
                   [this](publish& what) {
                     at_end([port = port_, what = std::move(what)] { port->publish(what.attempt, what.what); });
                   },
                   [this](announce& said) {
                     at_end(
                         [others = others_, said = std::move(said)] { others->say(said.sentence, said.is_warning); });
                   }},
               each);
}

} // namespace godwit::fleet_link
