#include "actors/operator_bridge/actor.hpp"

#include "actors/operator_bridge/audit_table.hpp"

namespace godwit::operator_bridge {

actor::actor(runtime::spawn_context context, const settings& configured, executor_handle executor,
             std::shared_ptr<presence> shown, std::vector<control_listener> listeners,
             std::shared_ptr<session_ends> ends, std::vector<holder_ear> holder_ears)
    : durable_actor(std::move(context)), settings_(configured), executor_(std::move(executor)),
      presence_(std::move(shown)), listeners_(std::move(listeners)), ends_(std::move(ends)),
      holder_ears_(std::move(holder_ears)) {}

actor::~actor() = default;

template <class Q, class R>
auto actor::decides(std::pair<effects, R> (core::*judge)(const Q&, instant)) {
  return on_deferred<Q, R>([this, judge](const Q& m, std::uint64_t request_id) {
    const auto [wanted, answer] = ((*core_).*judge)(m, now());
    execute(wanted);
    after_commit([this, request_id, answer = answer] { answer_later(request_id, answer); });
  });
}

actor::behavior_type actor::handlers() {
  return {on_deferred<operator_command, command_answer>(
              [this](const operator_command& m, std::uint64_t request_id) { take(m, request_id); }),
          decides(&core::on_control), on<get_operators>([this](const get_operators&) { return core_->describe(); }),
          decides(&core::on_read_audit),
          on<audit_note>([this](const audit_note& m) { execute(core_->on_note(m, now())); }), decides(&core::on_link),
          decides<open_session, session_answer>(&core::on_open), decides<use_link, session_answer>(&core::on_open),
          // From memory: it is asked for with each request.
          on<identify>([this](const identify& m) {
            auto [wanted, answer] = core_->on_identify(m, now());
            execute(wanted);
            return answer;
          }),
          decides(&core::on_end), decides(&core::on_leave),
          on<accounts_read>([this](const accounts_read& m) { execute(core_->on_accounts(m, now())); })};
}

void actor::started() {
  core_.emplace(settings_, current_state(), now());
  execute(core_->on_start(now()));
}

// What the journal does not take any more is not promised either.
void actor::take(const operator_command& m, std::uint64_t request_id) {
  if (is_refused_by_journal() && !operators::is_stop(m.what.kind))
    answer_later(request_id, command_answer{verdict::busy, "the disk takes nothing now; hold and return still go out"});
  else
    execute(core_->on_command(m, request_id, now()));
}

void actor::add_rows(const durable_core::event& happened, runtime::journal_write& write) {
  if (const auto* const one = std::get_if<audited>(&happened))
    put_row(write, one->row);
  if (const auto* const moved = std::get_if<rows_moved>(&happened))
    for (const auto& each : moved->rows)
      put_row(write, each);
}

void actor::on_deadline() { execute(core_->on_time(now())); }

void actor::execute(const effects& wanted) {
  for (const auto& each : wanted)
    std::visit([this](const auto& what) { execute(what); }, each);
  plan_deadline();
  show_presence();
  tell_control();
}

void actor::execute(const hand_over& each) {
  if (each.at_once)
    send_at_once([this, &each] { ask_executor(each.number, each.what); });
  else
    after_commit([this, number = each.number] { release(number); });
}

void actor::execute(const reply& each) {
  if (each.waits)
    after_commit([this, each] { answer_later(each.request, each.answer); });
  else
    answer_later(each.request, each.answer);
}

void actor::execute(const session_over& each) {
  at_end([this, session = each.session] { ends_->notify(session); });
}

void actor::release(std::uint64_t number) {
  const auto decided = core_->on_written(number, now());
  if (decided.goes)
    ask_executor(number, decided.what);
  else if (!decided.otherwise.empty())
    at_end([this, decided] { execute(decided.otherwise); });
}

void actor::ask_executor(std::uint64_t number, const operators::command& what) {
  ask(
      executor_, executor_patience, what,
      [this, number](const operators::answer& answer) { execute(core_->on_answer(number, answer, now())); },
      [this, number](const runtime::ask_error& why) {
        execute(core_->on_no_answer(number, why.code != runtime::ask_errc::not_taken, now()));
      });
}

// When it is on the disk: what a killed process has told is true of the next one.
void actor::tell_control() {
  const auto& control = current_state().control;
  auto holder = control ? control->who.name : std::string();
  if (told_control_ == holder)
    return;
  told_control_ = holder;
  after_commit([this, holder = std::move(holder)] {
    for (const auto& each : listeners_)
      tell(each, control_news{holder});
  });
}

void actor::show_presence() {
  if (const auto heard_ns = core_->operator_heard_ns())
    at_end([this, at_ns = *heard_ns] { presence_->hear(at_ns); });
  if (core_->takes_holder_news(now()))
    at_end([this] {
      for (const auto& each : holder_ears_)
        tell(each, holder_heard{});
    });
}

void actor::plan_deadline() {
  if (const auto due_ns = core_->next_due_ns(); due_ns != core::never_due)
    wake_at(due_ns);
}

} // namespace godwit::operator_bridge
