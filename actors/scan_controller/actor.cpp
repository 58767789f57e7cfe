#include "actors/scan_controller/actor.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "io/mavlink/frame_meaning.hpp"

namespace godwit::scan_controller {

using mapobjects_store::map_failure;

actor::actor(runtime::spawn_context context, settings configured, std::shared_ptr<const peers> others,
             std::uint64_t process)
    : durable_actor(std::move(context)), settings_(std::move(configured)), others_(std::move(others)),
      process_(process), core_(settings_) {}

actor::~actor() = default;

actor::behavior_type actor::handlers() {
  return {on_deferred<candidate, candidate_answer>(
              [this](const candidate& seen, std::uint64_t request_id) { take(seen, request_id); }),
          on_deferred<decide_point, decide_answer>(
              [this](const decide_point& said, std::uint64_t request_id) { take(said, request_id); }),
          on_deferred<get_points, points>([this](const get_points&, std::uint64_t request_id) {
            turn();
            after_commit(
                [this, request_id, seen = core::view_of(current_state(), now())] { answer_later(request_id, seen); });
          }),
          on<survey_progress>([this](const survey_progress& seen) { take(seen); }),
          on<view>([this](const view& said) {
            view_.on_view(said, now().monotonic_ns);
            turn();
          }),
          on<io::mavlink::global_position_int>([this](const io::mavlink::global_position_int& m) {
            using io::mavlink::units_a_degree;
            const geo::point here{m.lat / units_a_degree, m.lon / units_a_degree};
            if (geo::is_valid(here))
              core_.on_vehicle_at(here);
          })};
}

void actor::started() {
  if (const auto restarted = core::on_start(current_state(), now()))
    commit(*restarted);
  view_.on_view({true, {}}, now().monotonic_ns); // who looks says it soon
  turn();
}

void actor::take(const candidate& seen, std::uint64_t request_id) {
  turn(); // what was due before it came
  const auto judged = core_.on_candidate(current_state(), seen, now());
  for (const auto& each : judged.facts)
    commit(each);
  turn();
  after_commit([this, request_id, answer = judged.answer] { answer_later(request_id, answer); });
}

void actor::take(const decide_point& said, std::uint64_t request_id) {
  const auto decided = core::on_decision(current_state(), said, now());
  if (decided.what)
    commit(*decided.what);
  turn();
  after_commit([this, request_id, answer = decided.answer] { answer_later(request_id, answer); });
}

void actor::take(const survey_progress& seen) {
  look_at_view(); // as it was until now
  view_.is_on_lines = seen.is_flying && !seen.is_at_beginning;
  while (const auto next = on_survey(current_state(), settings_, seen, process_, now())) {
    commit(*next);
    if (const auto* lost = std::get_if<pass_lost>(&*next))
      lose_pass(*lost);
  }
  turn();
}

void actor::look_at_view() {
  const auto lost = on_view(current_state(), settings_, view_, now().monotonic_ns);
  if (!lost)
    return;
  commit(*lost);
  lose_pass(std::get<pass_lost>(*lost));
}

void actor::lose_pass(const pass_lost& how) {
  at_end([this, why = how.why] {
    others_->say("a survey is no whole pass, and none of its objects is reported gone: " + why, false);
  });
}

void actor::turn() {
  look_at_view();
  while (const auto due = core_.next_due(current_state(), now()))
    commit(*due);
  deliver();
  post_health();
  auto next_ns = core_.next_deadline_ns(current_state());
  const auto& s = current_state();
  if (!is_asking_map_ && !s.owed.empty())
    next_ns = std::min(next_ns, ask_map_from_ns_);
  if (!is_asking_map_ && !s.owed_passes.empty())
    next_ns = std::min(next_ns, std::max(ask_map_from_ns_, s.owed_passes.front().due_ns));
  if (settings_.watches_view && s.pass && !s.pass->is_over && view_.is_on_lines)
    next_ns = std::min(next_ns, view_.seen_until_ns);
  wake_at(next_ns);
}

// One at a time, the oldest first, when it is on the disk.
void actor::deliver() {
  const auto& s = current_state();
  const auto at_ns = now().monotonic_ns;
  if (is_asking_map_ || at_ns < ask_map_from_ns_)
    return;
  if (!s.owed.empty()) {
    is_asking_map_ = true;
    after_commit([this, what = s.owed.front()] {
      ask_map<mapobjects_store::operator_verdict, mapobjects_store::verdict_answer, verdict_delivered>(what);
    });
  } else if (!s.owed_passes.empty() && s.owed_passes.front().due_ns <= at_ns) {
    is_asking_map_ = true;
    after_commit([this, what = s.owed_passes.front().what] {
      ask_map<mapobjects_store::pass_end, mapobjects_store::pass_answer, pass_delivered>(what);
    });
  }
}

// What the map refuses it would refuse again.
template <class Owed, class Answer, class Delivered>
void actor::ask_map(const Owed& what) {
  const auto not_now = [this](const std::string& why) {
    is_asking_map_ = false;
    map_error_ = why;
    ask_map_from_ns_ = now().monotonic_ns + map_retry_ns;
    turn();
  };
  ask(
      others_->map, map_patience, what,
      [this, not_now, id = what.id](const Answer& answer) {
        if (answer.failure != map_failure::none && answer.failure != map_failure::refused)
          return not_now(answer.error);
        is_asking_map_ = false;
        map_error_.clear();
        commit(Delivered{id});
        if (answer.failure == map_failure::refused)
          at_end([this, why = answer.error] {
            others_->say("the map refuses what a person or a pass has reported: " + why, true);
          });
        turn();
      },
      [not_now](const runtime::ask_error& why) { not_now(why.what); });
}

void actor::dispatch(const durable_core::effect& each) {
  std::visit(
      [this](const auto& what) {
        for (const auto& subscriber : others_->subscribers)
          tell(subscriber, what);
      },
      each);
}

void actor::post_health() {
  using runtime::health_colour;
  const auto& s = current_state();
  const auto owed = s.owed.size() + s.owed_passes.size();
  if (owed != 0 && !map_error_.empty())
    show_health(
        {health_colour::yellow, std::to_string(owed) + " decisions and passes wait for the map: " + map_error_});
  else
    show_health({health_colour::green, {}});
}

} // namespace godwit::scan_controller
