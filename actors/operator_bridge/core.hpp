// What operator_bridge decides about what operators say.
//
//   operator_command ──> session? ──> role? ──> said before? ──> in time? ──> control? ──> room? ──┬─> a stop: handed
//   over
//        │                  │           │           │               │            │           │     │   at once
//        └── one row of the audit, and an answer, for each <────────┴────────────┴───────────┘     └─> else when that
//        is
//                                                                                                      on the disk
//
// A command that was handed over is never handed over again: what moves the vehicle is not durable. When nobody can say
// what became of it, because a process died meanwhile, its answer is `unknown`. A stop (hold, return) is open to every
// operator at any time, is not late as a hold, is not stale, and goes out before it is written: it may come twice,
// which does no harm. It empties what waits for the disk. Whether the vehicle may be moved is the executor's to say,
// and whether the command was meant for how the flight stands. Pure: time comes in. Thread: one owner.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "actors/operator_bridge/audit.hpp"
#include "actors/operator_bridge/control.hpp"
#include "actors/operator_bridge/effects.hpp"
#include "actors/operator_bridge/sessions.hpp"
#include "actors/operator_bridge/settings.hpp"
#include "io/time_units.hpp"

namespace godwit::operator_bridge {

class core {
public:
  static constexpr std::int64_t never_due = std::numeric_limits<std::int64_t>::max();
  static constexpr std::int64_t usual_validity_ns = 10 * ns_per_s;   // of a command that does not say it
  static constexpr std::int64_t longest_validity_ns = 60 * ns_per_s; // so that its id is known until it is late
  static constexpr std::int64_t release_within_ns = 1'500'000'000;   // or the disk is too slow for it
  static constexpr std::int64_t holder_news_ns = 1 * ns_per_s;
  static constexpr std::size_t max_under_way = 16;
  static constexpr std::size_t max_stops_under_way = 8; // of one kind; more wait for the answer of the newest
  static constexpr std::size_t max_askers = 8;          // of one command

  core(const settings& set, const state& durable, instant now);

  // What an earlier incarnation had handed over.
  [[nodiscard]] effects on_start(instant now);
  [[nodiscard]] effects on_command(const operator_command& m, std::uint64_t request, instant now);

  struct released {
    bool goes = false;
    operators::command what;
    effects otherwise; // where it does not go
  };
  // What NUMBER has decided is on the disk.
  [[nodiscard]] released on_written(std::uint64_t number, instant now);
  [[nodiscard]] effects on_answer(std::uint64_t number, const operators::answer& m, instant now);
  // WAS_TAKEN: it may have been obeyed.
  [[nodiscard]] effects on_no_answer(std::uint64_t number, bool was_taken, instant now);

  [[nodiscard]] std::pair<effects, leave> on_leave(const ask_leave& m, instant now);
  [[nodiscard]] std::pair<effects, control_answer> on_control(const change_control& m, instant now);
  [[nodiscard]] std::pair<effects, session_answer> on_open(const open_session& m, instant now);
  [[nodiscard]] std::pair<effects, session_answer> on_open(const use_link& m, instant now);
  [[nodiscard]] std::pair<effects, link_answer> on_link(const make_link& m, instant now);
  [[nodiscard]] std::pair<effects, session_ended> on_end(const end_session& m, instant now);
  [[nodiscard]] std::pair<effects, identity> on_identify(const identify& m, instant now);
  [[nodiscard]] effects on_accounts(const accounts_read& m, instant now);
  [[nodiscard]] effects on_note(const audit_note& m, instant now);
  [[nodiscard]] std::pair<effects, audit_leave> on_read_audit(const read_audit& m, instant now);
  [[nodiscard]] operators_view describe() const;

  // Monotonic; on_time is due then.
  [[nodiscard]] std::int64_t next_due_ns() const;
  [[nodiscard]] effects on_time(instant now);

  // When somebody who may fly was heard last; none: nobody yet.
  [[nodiscard]] std::optional<std::int64_t> operator_heard_ns() const { return operator_heard_ns_; }

  // True: whoever has control was heard since the last call, and others are to be told.
  [[nodiscard]] bool takes_holder_news(instant now);

private:
  struct under_way {
    kept_command as;
    operators::command what;
    std::vector<std::uint64_t> askers;
    std::int64_t since_ns = 0; // monotonic
    bool is_stop = false;
    bool is_out = false; // with the executor
  };

  [[nodiscard]] command_answer objection_to(const operator_command& m, instant now) const;
  [[nodiscard]] bool repeat(effects& out, const operator_command& m, std::uint64_t request, instant now);
  [[nodiscard]] bool can_have_id(const operator_command& m);
  void admit_without_id(effects& out, operator_command m, std::uint64_t request, instant now);
  void refuse(effects& out, const operator_command& m, std::uint64_t request, command_answer answer, instant now);
  void admit(effects& out, const operator_command& m, std::uint64_t request, instant now);
  void supersede_waiting(effects& out, const operators::principal& by, instant now);
  void end(effects& out, std::uint64_t number, command_answer answer, instant now);
  void put_row(effects& out, const operators::principal& by, const operators::command& what, const std::string& id,
               const command_answer& answer, instant now);
  [[nodiscard]] under_way* find_under_way(const operator_command& m);
  [[nodiscard]] bool is_known(effects& out, const operators::principal& by, const std::string& what, instant now);
  void hear(const operators::principal& who, instant now);

  settings set_;
  const state& s_;
  audit audit_;
  control control_;
  sessions sessions_;
  std::map<std::uint64_t, under_way> under_way_; // by its number
  std::uint64_t last_number_;
  std::int64_t swept_ns_;
  std::uint64_t commands_ = 0;
  std::uint64_t refused_ = 0;
  std::optional<std::int64_t> operator_heard_ns_; // monotonic
  bool is_holder_heard_ = false;                  // since that was asked
  std::int64_t holder_told_ns_ = 0;               // monotonic
};

} // namespace godwit::operator_bridge
