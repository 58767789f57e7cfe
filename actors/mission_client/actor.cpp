#include "actors/mission_client/actor.hpp"

#include <algorithm>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "actors/mission_client/outbox/keys.hpp"
#include "io/fields/json_text.hpp"
#include "runtime/content_hash.hpp"

namespace godwit::mission_client {

namespace {

runtime::delivery_state state_of(const row_noted& noted) {
  if (noted.how == noted_as::delivered || noted.how == noted_as::returned)
    return runtime::delivery_state::delivered;
  if (noted.how == noted_as::dropped || noted.row.state == row_state::orphaned)
    return runtime::delivery_state::orphaned;
  return noted.row.state == row_state::expired ? runtime::delivery_state::expired : runtime::delivery_state::pending;
}

std::string body_for_people(const outbox_row& row) {
  std::string text = R"({"mission_id":)";
  io::append_json_string(text, row.mission_id);
  if (!row.subject.empty())
    io::append_json_string(text += R"(,"assignment_id":)", row.subject);
  if (!row.body.empty())
    text += R"(,"posted":)" + row.body;
  return text + "}";
}

runtime::outbox_row table_row(const row_noted& noted) {
  const auto& row = noted.row;
  return {.idempotency_key = row.key,
          .destination = std::string(io::name_of(row.to)),
          .body = body_for_people(row),
          .created_ns = row.created_ns,
          .state = state_of(noted),
          .tries = row.tries,
          .last_error = row.last_error,
          .next_try_ns = row.next_try_ns,
          .first_failure_ns = row.first_failure_ns};
}

// Delivered rows, and changes that are over: nothing of them can be sent again.
constexpr const char* prune_table =
    "DELETE FROM outbox WHERE actor = ?1 AND (state = 'delivered' OR state <> 'pending' AND destination IN "
    "('waypoint', 'tail')) AND created_ns < (SELECT created_ns FROM outbox WHERE actor = ?1 AND (state = 'delivered' "
    "OR "
    "state <> 'pending' AND destination IN ('waypoint', 'tail')) ORDER BY created_ns DESC LIMIT 1 OFFSET ?2)";

} // namespace

template <class M>
auto actor::hears() {
  return on<M>([this](const M& message) {
    commit(durable_core::event(message));
    decision_context();
  });
}

actor::actor(runtime::spawn_context context, settings configured, std::shared_ptr<service_port> service,
             std::shared_ptr<const peers> others, std::uint64_t seed)
    : durable_actor(std::move(context)), settings_(configured), service_(std::move(service)),
      others_(std::move(others)), seed_(seed) {}

actor::~actor() = default;

actor::behavior_type actor::handlers() {
  return {hears<begin_mission>(),
          hears<begin_next>(),
          hears<pull_map>(),
          hears<accept_copy>(),
          hears<push_map>(),
          hears<report_progress>(),
          hears<respond_to_assignment>(),
          hears<insert_waypoint>(),
          hears<replace_tail>(),
          on<get_service>([this](const get_service&) { return status(); }),
          on_request<retry_outbox, retry_answer>(),
          on_request<deliver_picture, picture_noted>(),
          on<wake>([this](const wake&) { decision_context(); })};
}

void actor::on_deadline() { decision_context(); }

void actor::started() {
  const auto& s = current_state();
  const auto life = hash_of(s.mission_id, incarnation_number() ^ s.next_order) ^ static_cast<std::uint64_t>(wall_ns());
  planner_.emplace(settings_, seed_ ^ life);
  planner_->on_disk({s.next_order, false});
  service_->cancel_all();
  if (goes_on_with_mission(s))
    commit(begun_anew{});
  tell(me(), wake{});
}

// -- a turn: what came in, then what is to be done ------------------------------------------------

void actor::decision_context() {
  if (const auto by_ns = clock_.jump(now()))
    commit(clock_jumped{*by_ns});
  take_answers();
  plan();
  post_health();
  wake_at(planner_->wake_ns());
}

void actor::take_answers() {
  while (const auto news = next_answer()) {
    if (!news->call) {
      ++stray_answers_;
      continue;
    }
    if (news->what.how != ending::page_begun)
      std::erase_if(calls_, [&](const auto& each) { return each.second == *news->call; });
    execute(planner_->on_answer(current_state(), now(), *news->call, news->what));
  }
}

service_news actor::news_of_call(service_answer answer) {
  const auto call = calls_.find(answer.number);
  return {call == calls_.end() ? std::nullopt : std::optional(call->second), std::move(answer)};
}

// The numbers of the port differ in a replay, the planner's do not.
std::optional<service_news> actor::next_answer() {
  std::optional<service_news> came;
  std::size_t from = 0;
  auto first = take_beside<recorded_answer>([&]() -> std::optional<recorded_answer> {
    auto answer = service_->answers().take();
    if (!answer)
      return std::nullopt;
    came = news_of_call(*std::move(answer));
    return next_part(*came, from);
  });
  if (!first)
    return std::nullopt;
  const auto parts = first->parts;
  auto result = news_of(*std::move(first));
  for (std::uint32_t part = 1; part < parts; ++part)
    if (const auto next = take_beside<recorded_answer>([&] { return std::optional(next_part(*came, from)); }))
      result.what.body += next->body;
  return came ? std::move(came) : std::optional(std::move(result));
}

// Until it wants nothing more of the state.
void actor::plan() {
  for (int i = 0;; ++i) {
    if (i == max_plans_per_turn)
      throw std::logic_error("mission_client does not come to an end with what it wants");
    auto wanted = planner_->plan(current_state(), now());
    const bool is_done = wanted.events.empty();
    execute(std::move(wanted));
    if (is_done)
      return;
  }
}

void actor::execute(requests wanted) {
  for (const auto number : wanted.cancelled) {
    const auto call = std::ranges::find_if(calls_, [&](const auto& each) { return each.second == number; });
    if (call == calls_.end()) // a question to the store: its answer will find nobody
      continue;
    service_->cancel(call->first);
    calls_.erase(call);
    if (is_recorded())
      note_call("cancel call " + std::to_string(number), runtime::empty_hash);
  }
  for (auto& each : wanted.calls) {
    if (is_recorded())
      note_call((each.call.is_post ? "POST " : "GET ") + each.call.target,
                runtime::content_hash(each.call.body, runtime::content_hash(each.call.key)));
    calls_.emplace(service_->send(std::move(each.call)), each.number);
  }
  for (const auto& each : wanted.questions)
    ask_store(each.number, each.question);
  for (const auto& each : wanted.events)
    commit(each);
}

void actor::ask_store(ticket number, const store_question& asked) {
  const auto then = [this, number](const store_answer& answer) {
    execute(planner_->on_store(current_state(), now(), number, answer));
    decision_context();
  };
  std::visit(
      [&](const auto& question) {
        ask(
            others_->map, store_patience, question, [then](const auto& answer) { then(answer); },
            [then](const runtime::ask_error& why) { then(store_silent{why.what}); });
      },
      asked);
}

void actor::post_health() { show_health(planner_->health(current_state())); }

service_status actor::status() const { return planner_->status(current_state()); }

// -- effects --------------------------------------------------------------------------------------

bool actor::stage(const durable_core::effect& each, runtime::journal_write& write) {
  if (const auto* noted = std::get_if<row_noted>(&each)) {
    write.outbox.push_back(table_row(*noted));
    return true;
  }
  if (std::holds_alternative<table_pruned>(each)) {
    write.rows.push_back({prune_table, {actor_name(), max_resolved_rows_shown}});
    return true;
  }
  return false;
}

void actor::dispatch(const durable_core::effect& each) {
  std::visit(
      [this]<class M>(const M& m) {
        if constexpr (runtime::accepts<listener_handle, M>) {
          tell(others_->listener, m);
        } else if constexpr (std::is_same_v<M, on_disk>) {
          planner_->on_disk(m);
          tell(me(), wake{});
        }
      },
      each);
}

} // namespace godwit::mission_client
