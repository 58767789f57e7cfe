// A journal in memory for tests: the same promises as sqlite_journal, with every commit under the test's control.
//
// simulated_disk is what survives the process; simulated_journal is the writer and dies with it. Nothing happens until
// step(): then all that waits commits in one group and the callbacks run, in the caller's thread. The disk can be told
// to fail. With a file below it the disk is that file, which decides what commits and is what a process recovers from;
// what was acknowledged is kept in memory as well, and held against it. Thread: one.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "runtime/journal/journal.hpp"

namespace godwit::runtime {

// The writer of one process on a real file. Its end is that of the process: what was not committed is gone.
class file_below {
public:
  file_below() = default;
  file_below(const file_below&) = delete;
  file_below& operator=(const file_below&) = delete;
  virtual ~file_below() = default;
  [[nodiscard]] virtual journal& writer() = 0; // calls back in run_once() alone
  virtual void run_once() = 0;                 // at most one transaction
};

class simulated_disk {
public:
  struct actor_rows {
    recovered kept;
  };

  std::map<std::string, actor_rows> actors;
  std::vector<row_change> rows;             // what was written to typed tables, in order
  std::map<std::string, outbox_row> outbox; // by key
  std::vector<dead_letter> dead_letters;
  std::uint64_t runs = 0;
  std::uint64_t commits = 0;
  std::function<std::unique_ptr<file_below>()> below = {}; // of each process; none: memory alone
  std::uint64_t forgotten = 0;                             // recoveries that lacked what had been acknowledged
};

class simulated_journal final : public journal {
public:
  explicit simulated_journal(simulated_disk& disk);
  ~simulated_journal() override { is_gone_ = true; }

  [[nodiscard]] tl::expected<void, journal_error> submit(journal_write&& write) override;
  void recover(std::string actor, std::uint64_t incarnation, recovered_callback callback) override;
  [[nodiscard]] journal_status status() const override;

  // Does one step of work; false when nothing waits (or only writes do, and the disk fails).
  bool step();
  void fail_writes(bool failing) { failing_ = failing; }
  // As if its queue was full.
  void refuse_writes(bool refusing) { refusing_ = refusing; }
  // As while the disk syncs: nothing commits, and what is after a write waits with it. It does not fail.
  void hold(bool holding) { holding_ = holding; }
  // The next write of ACTOR with an event can never commit, nor can the first after each of the next TIMES - 1
  // recoveries.
  void break_writes_of(const std::string& actor, int times) { to_break_[actor] = times; }
  [[nodiscard]] std::size_t waiting() const {
    return below_ ? static_cast<std::size_t>(below_->writer().status().queued) : queue_.size() + failed_.size();
  }

private:
  struct recovery {
    std::string actor;
    recovered_callback callback;
  };
  using queued_item = std::variant<journal_write, recovery>;

  [[nodiscard]] tl::expected<void, journal_error> submit_below(journal_write&& write);
  void recover_below(const std::string& actor, std::uint64_t incarnation, recovered_callback callback);
  void look_at(const std::string& actor, const recovered& found);
  bool step_below();
  void commit_group();
  [[nodiscard]] bool breaks(const journal_write& write);
  [[nodiscard]] bool is_broken(const journal_write& write) const;
  void tell_failed();
  bool recover_while_failing();
  void answer(const recovery& asked, const std::deque<queued_item>& ahead);

  simulated_disk& disk_;
  std::deque<queued_item> queue_;
  std::map<std::string, std::uint64_t> newest_incarnation_;
  bool failing_ = false;
  bool refusing_ = false;
  bool holding_ = false;
  std::map<std::string, int> to_break_;
  std::vector<journal_write> failed_;           // and not told yet
  std::map<std::string, journal_error> broken_; // actors with a write that can never commit, until they recover
  journal_status counted_;
  std::uint64_t called_back_ = 0; // by the file below
  bool is_gone_ = false;          // with the process: who waits hears nothing any more
  std::unique_ptr<file_below> below_;
};

// Adds one write to what an actor has; the one place where the meaning of a write is told.
void apply(const journal_write& write, simulated_disk& disk);

} // namespace godwit::runtime
