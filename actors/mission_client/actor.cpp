#include "actors/mission_client/actor.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "actors/mission_client/keys.hpp"
#include "io/fields/json_text.hpp"

namespace godwit::mission_client {

namespace {

runtime::health_colour colour_of(wellness how) {
  switch (how) {
  case wellness::well:
    return runtime::health_colour::green;
  case wellness::impaired:
    return runtime::health_colour::yellow;
  case wellness::bad:
    break;
  }
  return runtime::health_colour::red;
}

runtime::delivery_state state_of(const row_noted& noted) {
  if (noted.how == noted_as::delivered)
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
    tell(me(), wake{});
    commit(durable_core::event(message));
  });
}

actor::behavior_type actor::handlers() {
  return {hears<begin_mission>(),
          hears<pull_map>(),
          hears<push_map>(),
          hears<report_progress>(),
          hears<respond_to_assignment>(),
          hears<insert_waypoint>(),
          hears<replace_tail>(),
          on<get_service>([this](const get_service&) { return status(); }),
          on_request<retry_outbox, retry_answer>(),
          on<wake>([this](const wake&) { turn(); }),
          on<timer>([this](const timer& which) {
            if (which.number != timer_number_)
              return;
            timer_due_ns_ = never_ns;
            turn();
          })};
}

void actor::started() {
  const auto& s = current_state();
  const auto life = hash_of(s.mission_id, incarnation() ^ s.next_order) ^ static_cast<std::uint64_t>(wall_ns());
  planner_.emplace(settings_, seed_ ^ life);
  planner_->on_disk({s.next_order, false});
  service_->cancel_all();
  tell(me(), wake{});
}

// -- a turn: what came in, then what is to be done; one event at its end --------------------------

void actor::turn() {
  if (const auto by_ns = clock_.jump(now()))
    to_commit_.emplace_front(clock_jumped{*by_ns});
  if (to_commit_.empty())
    take_answers();
  if (to_commit_.empty()) // else the state is not yet what the answers have made of it
    carry_out(planner_->plan(current_state(), now()));
  end_turn();
}

void actor::take_answers() {
  while (to_commit_.empty()) {
    const auto answer = service_->answers().take();
    if (!answer)
      return;
    const auto call = calls_.find(answer->number);
    if (call == calls_.end()) {
      ++stray_answers_;
      continue;
    }
    const auto number = call->second;
    calls_.erase(call);
    carry_out(planner_->on_answer(current_state(), now(), number, *answer));
  }
}

void actor::carry_out(wishes wanted) {
  for (const auto number : wanted.cancelled) {
    const auto call = std::ranges::find_if(calls_, [&](const auto& each) { return each.second == number; });
    if (call == calls_.end()) // a question to the store: its answer will find nobody
      continue;
    service_->cancel(call->first);
    calls_.erase(call);
  }
  for (auto& each : wanted.calls)
    calls_.emplace(service_->send(std::move(each.call)), each.number);
  for (const auto& each : wanted.questions)
    ask_store(each.number, each.question);
  for (auto& each : wanted.events)
    to_commit_.push_back(std::move(each));
}

void actor::ask_store(ticket number, const store_question& asked) {
  const auto then = [this, number](const store_answer& answer) {
    carry_out(planner_->on_store(current_state(), now(), number, answer));
    if (to_commit_.empty())
      tell(me(), wake{});
    end_turn();
  };
  std::visit(
      [&](const auto& question) {
        ask(
            others_->map, store_patience, question, [then](const auto& answer) { then(answer); },
            [then](const runtime::ask_error& why) { then(store_silent{why.what}); });
      },
      asked);
}

// Each handler gives one event to the journal; with the next turn comes the next one.
void actor::end_turn() {
  post_health();
  set_timer();
  if (to_commit_.empty())
    return;
  auto next = std::move(to_commit_.front());
  to_commit_.pop_front();
  tell(me(), wake{});
  commit(std::move(next));
}

// One timer is under way at a time; an earlier deadline overtakes it with a new number.
void actor::set_timer() {
  const auto due = planner_->wake_ns();
  if (timer_due_ns_ <= due)
    return;
  timer_due_ns_ = due;
  const auto delay = std::max<std::int64_t>(due - now_ns(), 0);
  tell_after(std::chrono::nanoseconds(delay), me(), timer{++timer_number_});
}

void actor::post_health() {
  auto how = planner_->health(current_state());
  if (posted_ == how)
    return;
  outside().health->post(actor_name(), colour_of(how.how), how.reason);
  posted_ = std::move(how);
}

service_status actor::status() const { return planner_->status(current_state()); }

// -- effects --------------------------------------------------------------------------------------

bool actor::stage(const durable_core::effect& each, runtime::journal_write& write) {
  if (const auto* noted = std::get_if<row_noted>(&each)) {
    write.outbox.push_back(table_row(*noted));
    return true;
  }
  if (std::holds_alternative<table_pruned>(each)) {
    write.rows.push_back({prune_table, {actor_name(), max_settled_rows_shown}});
    return true;
  }
  return false;
}

void actor::let_out(const durable_core::effect& each) {
  std::visit(
      [this]<class M>(const M& m) {
        if constexpr (runtime::accepts<listener_handle, M>) {
          tell(others_->listener, m);
        } else if constexpr (std::is_same_v<M, on_disk>) {
          planner_->on_disk(m);
          tell_after(std::chrono::nanoseconds(0), me(), wake{}); // without the effect's id: a repetition is welcome
        }
      },
      each);
}

} // namespace godwit::mission_client
