// A core of operator_bridge with its durable state, as its shell would run it: notes are applied, what is handed over
// is written down, and answers are kept by their request. Thread: one.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "actors/operator_bridge/core.hpp"

namespace godwit::operator_bridge::tests {

inline constexpr std::int64_t s = ns_per_s;

inline operators::principal local() {
  return {"desk", operators::role::engineer, std::string(operators::local_session)};
}

class bridge_world {
public:
  bridge_world() { core_.emplace(set, durable, now); }

  // -- who is there
  operators::principal log_in(const std::string& name, operators::role as = operators::role::operator_) {
    const auto [wanted, answer] = core_->on_open(open_session{{name, as, "stamp", {}}, "hash of " + name, "here"}, now);
    execute(wanted);
    return answer.who;
  }
  control_answer control(const operators::principal& by, control_act act, const std::string& to = {}) {
    const auto [wanted, answer] = core_->on_control({by, act, to}, now);
    execute(wanted);
    return answer;
  }
  operators::principal pilot(const std::string& name = "anna") {
    auto who = log_in(name);
    (void)control(who, control_act::take);
    return who;
  }

  // -- what they say
  [[nodiscard]] operator_command command(const operators::principal& by, operators::command_kind kind,
                                         const std::string& id = {}) const {
    operator_command result;
    result.id = id;
    result.valid_until_ns = now.wall_ns + 5 * s;
    result.by = by;
    result.what.kind = kind;
    return result;
  }
  std::uint64_t say(const operator_command& m) {
    execute(core_->on_command(m, ++last_request, now));
    return last_request;
  }
  // What it is answered when the executor takes what it is handed, at once.
  verdict say_all_the_way(const operator_command& m) {
    const auto request = say(m);
    write();
    for (const auto& each : std::exchange(with_executor, {}))
      answer(each.number, {true, {}, {}});
    return answers.contains(request) ? answers.at(request).verdict : verdict::unknown;
  }
  // The disk has all that was decided.
  void write() {
    for (const auto number : std::exchange(waiting, {})) {
      const auto decided = core_->on_written(number, now);
      if (decided.goes)
        out({number, decided.what, false});
      execute(decided.otherwise);
    }
  }
  void answer(std::uint64_t number, const operators::answer& m) { execute(core_->on_answer(number, m, now)); }
  void no_answer(std::uint64_t number, bool was_taken) { execute(core_->on_no_answer(number, was_taken, now)); }
  void pass(std::int64_t ns) {
    now.monotonic_ns += ns;
    now.wall_ns += ns;
    if (now.monotonic_ns >= core_->next_due_ns())
      execute(core_->on_time(now));
  }
  // What was not written is written, and who waited is forgotten.
  void crash() {
    waiting.clear();
    with_executor.clear();
    core_.emplace(set, durable, now);
    execute(core_->on_start(now));
  }
  core& decides() { return *core_; }
  void execute(const effects& wanted) {
    for (const auto& each : wanted)
      std::visit([this](const auto& what) { take(what); }, each);
  }

  // -- what came of it
  [[nodiscard]] std::vector<std::string> outcomes() const { // of all rows of the audit
    std::vector<std::string> result;
    for (const auto& [number, each] : audit)
      result.push_back(each.outcome);
    return result;
  }
  [[nodiscard]] std::uint32_t rows() const {
    std::uint32_t result = 0;
    for (const auto& [number, each] : audit)
      result += each.count;
    return result;
  }

  settings set;
  state durable;
  std::map<std::uint64_t, audit_row> audit; // the table, without its bounds
  std::uint64_t rows_written = 0;
  instant now{1'000 * s, 1'800'000'000 * s};
  std::uint64_t last_request = 0;
  std::map<std::uint64_t, command_answer> answers;
  std::map<std::uint64_t, int> answered;
  std::vector<std::uint64_t> waiting; // for the disk
  std::vector<hand_over> with_executor;
  std::vector<hand_over> handed; // all of them, ever
  std::vector<std::string> over; // sessions that have ended

private:
  void take(const note& each) {
    (void)durable_core::apply(durable, each.what, now.wall_ns);
    if (const auto* const row = std::get_if<audited>(&each.what)) {
      audit.insert_or_assign(row->row.number, row->row);
      ++rows_written;
    }
  }
  void take(const session_over& each) { over.push_back(each.session); }
  void take(const reply& each) {
    answers[each.request] = each.answer;
    ++answered[each.request];
  }
  void take(const hand_over& each) {
    if (each.at_once)
      out(each);
    else
      waiting.push_back(each.number);
  }
  void out(const hand_over& each) {
    with_executor.push_back(each);
    handed.push_back(each);
  }

  std::optional<core> core_;
};

} // namespace godwit::operator_bridge::tests
