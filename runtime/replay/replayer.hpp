// Runs a recorded actor again and holds what it does against what it did.
//
//   each input of the record ──> bench ─> what it sends  ─┐
//   each message that it sent, as others took it ─────────┴─> the same, by meaning and in order for each receiver?
//
// An input is one message, one answer, one timer, one word of the disk, or the beginning of an incarnation; with it
// comes what was taken beside the mailbox then. The clock of the bench stands at what it showed the handler. A message
// that the bench sends and the record does not have is a deviation only where its receiver is known to have gone on
// taking mail: it may have been dropped, or the process may have ended. Incarnations whose beginning is not in the
// record are left out, and counted. Thread: one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "runtime/replay/actor_bench.hpp"
#include "runtime/replay/comparison.hpp"
#include "runtime/replay/recorded_run.hpp"

namespace godwit::runtime {

enum class deviation_kind {
  differs,      // the message of the record and that of the bench, in the same place
  not_sent,     // in the record, and the bench has not sent it
  not_recorded, // the bench has sent it, and its receiver has not taken it
  crashes,      // on the bench alone
  not_done,     // beside messages, in the record: an input that is not taken, a call that is not made
  crashed,      // in the record alone
  can_not_take  // the input can not be handed to the actor
};

GODWIT_ENUM_NAMES(deviation_kind, differs, not_sent, not_recorded, not_done, crashes, crashed, can_not_take);

struct deviation {
  deviation_kind kind = deviation_kind::differs;
  const recorded_message* input = nullptr;    // at which it shows
  const recorded_message* expected = nullptr; // null: there is none
  std::optional<bench_sending> produced = {};
  std::vector<field_difference> fields = {};
  std::string what = {}; // of a crash, or why it can not be taken
};

struct replay_step {
  const recorded_message* input = nullptr;
  std::vector<const recorded_message*> expected; // what was taken of what it sent then
  const bench_result* produced = nullptr;
  bool is_same = true;
};

struct replay_options {
  std::int64_t tolerance_ns = 0;        // of times in messages
  std::uint64_t until = 0;              // the input with this id is the last one; 0: all
  std::size_t max_deviations = 1;       // then it ends
  std::int64_t monotonic_to_utc_ns = 0; // what the times of the record are ahead of the clock of its process
};

struct replay_summary {
  std::size_t inputs = 0;       // that were handed over
  std::size_t compared = 0;     // messages that were the same
  std::size_t unconfirmed = 0;  // that the bench sent and nobody can be asked about
  std::size_t incarnations = 0; // that were replayed
  std::size_t left_out = 0;     // whose beginning is not in the record
  std::size_t inputs_left_out = 0;
  std::size_t planned_crashes = 0; // of a test: their message is not expected to crash again
  std::size_t crashes = 0;         // in the record and on the bench
  std::vector<std::string> notes;  // why something was left out
  std::vector<deviation> deviations;
};

class replayer {
public:
  // ON has chosen the actor; RECORD and ON live longer than what is returned.
  replayer(actor_bench& on, const recorded_run& record, replay_options options);

  [[nodiscard]] replay_summary run(const std::function<void(const replay_step&)>& on_step);

private:
  [[nodiscard]] bool wants_more() const;
  void take(std::size_t at);
  void begin(std::size_t at);
  [[nodiscard]] tl::expected<recovered, std::string> restored_of(const recorded_message& first) const;
  void hand_over(const recorded_message& input);
  [[nodiscard]] bool expect_facts(const recorded_message& input);
  void judge(const recorded_message& input, bench_result& done);
  void judge_beside(const recorded_message& input, const handler_beside& each);
  void judge_made_by_itself(const recorded_message& input);
  [[nodiscard]] bool is_planned(const recorded_message& input, const bench_result& done) const;
  void leave_planned(const recorded_message& input);
  [[nodiscard]] bool judge_end(const recorded_message& input, const bench_result& done);
  void judge_missing(const recorded_message& input);
  void match(const recorded_message& input, const bench_sending& each);
  void judge_unrecorded(const recorded_message& input, const bench_sending& each);
  void leave_out(const recorded_message& input, std::string why);
  void find(deviation what);
  [[nodiscard]] bool is_here(std::size_t output) const;
  [[nodiscard]] std::vector<std::size_t> expected_of(std::uint64_t cause) const;
  [[nodiscard]] bench_moment moment_of(const recorded_message& input) const;

  actor_bench& bench_;
  const recorded_run& record_;
  const replay_options options_;
  replay_summary summary_;
  std::vector<bool> used_;                             // of the outputs: compared, or left out
  std::multimap<std::uint64_t, std::size_t> by_cause_; // outputs, in order for each cause
  std::uint32_t incarnation_ = 0;
  bool is_left_out_ = true;                     // the incarnation
  std::uint64_t first_id_ = 0;                  // that the incarnation made
  std::uint64_t end_id_ = 0;                    // that the next one made; 0: there is none
  std::vector<const recorded_message*> beside_; // the mailbox, of the step
  std::size_t made_by_itself_ = 0;              // inputs to come that the bench has handled with the beginning
  bench_result shown_;                          // of the step
  replay_step step_;
};

} // namespace godwit::runtime
