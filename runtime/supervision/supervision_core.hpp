// The supervisor's decisions, without actors: which child to start, stop, wait for or give up.
//
//               up                      crash, again at once
//   absent ──> starting ──> running ─────────────────────────> absent
//     ▲            │crash      │ crash, again after a wait
//     │            └──────────>├──────────> waiting ──due──> absent
//     │ stopped                │ too many crashes
//   stopping <── must stop ────┴──────────> given_up
//
// One rule drives all: after each event the table is looked at again. What must stop is stopped, last started first,
// one at a time; what is wanted, absent and allowed to start is started in order. A child that stops delays no other's
// start, but for rest_for_one, where a child may run only while all before it run. A child's first start waits until
// all before it have been up once; not for one that has crashed twice in its own, unless that is essential and may
// still be given up. Thread: one owner. Pure: time and randomness are passed in.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "runtime/random.hpp"
#include "runtime/supervision/policy.hpp"

namespace godwit::runtime {

// How often a child crashed lately, and what that means: again at once, again after a wait, or no more.
// Thread: one owner.
class restart_history {
public:
  // The wait before the restart in nanoseconds, or nothing: the child is given up.
  [[nodiscard]] std::optional<std::int64_t> on_crash(const restart_policy& policy, std::int64_t now_ns,
                                                     random_source& random);
  void forget() { crashes_.clear(); }

private:
  std::deque<std::int64_t> crashes_; // times in the period, oldest first; at most intensity + 1
};

struct start_child {
  std::size_t child = 0;
};
struct stop_child {
  std::size_t child = 0;
  bool for_good = false; // else it will be started again, and its mail is kept for then
};
struct await_restart {
  std::size_t child = 0;
  std::int64_t delay_ns = 0;
};
struct give_up_child {
  std::size_t child = 0;
};
struct bring_down {
  std::size_t child = 0; // the essential child because of which the process ends
};
struct all_stopped {};

using supervision_action = std::variant<start_child, stop_child, await_restart, give_up_child, bring_down, all_stopped>;

class supervision_core {
public:
  using actions = std::vector<supervision_action>;

  supervision_core(strategy how, const std::vector<child_policy>& children, std::uint64_t seed);

  [[nodiscard]] actions start();
  [[nodiscard]] actions shutdown();
  [[nodiscard]] actions up(std::size_t i);
  // The incarnation is gone. RESTART_IS_USELESS: give up at once (its durable state can not be read).
  [[nodiscard]] actions down(std::size_t i, std::int64_t now_ns, bool restart_is_useless = false);
  [[nodiscard]] actions restart_due(std::size_t i);
  // Somebody wants the child to run, or not. Its crashes stay as they are, and so does one that was given up.
  [[nodiscard]] actions want(std::size_t i, bool wanted);
  // One that was given up may start again, with its crashes forgotten.
  [[nodiscard]] actions revive(std::size_t i);
  void set_policy(std::size_t i, child_policy policy) { children_[i].policy = policy; }

  [[nodiscard]] child_phase phase(std::size_t child) const { return children_[child].phase; }
  [[nodiscard]] bool is_wanted(std::size_t child) const { return children_[child].wanted; }
  [[nodiscard]] const child_policy& policy(std::size_t child) const { return children_[child].policy; }
  [[nodiscard]] std::uint64_t restarts(std::size_t child) const { return children_[child].restarts; }
  [[nodiscard]] std::size_t size() const { return children_.size(); }
  [[nodiscard]] bool shutting_down() const { return shutting_down_; }
  // Each child that is wanted has been up once, or was given up.
  [[nodiscard]] bool has_begun() const;

private:
  struct entry {
    child_policy policy;
    child_phase phase = child_phase::absent;
    bool wanted = true;
    bool been_up = false;
    bool is_late = false; // waits for another try of its first start
    std::uint64_t restarts = 0;
    restart_history history;
  };

  void look_again(actions& out);
  [[nodiscard]] bool stop_one(actions& out); // true: a child is stopping
  [[nodiscard]] bool must_stop(std::size_t i) const;
  [[nodiscard]] bool may_start(std::size_t i) const;
  [[nodiscard]] static bool lets_later_start(const entry& before);
  void crashed(std::size_t i, std::int64_t now_ns, bool restart_is_useless, actions& out);

  strategy strategy_;
  std::vector<entry> children_;
  random_source random_;
  bool started_ = false;
  bool shutting_down_ = false;
  bool told_stopped_ = false;
};

} // namespace godwit::runtime
