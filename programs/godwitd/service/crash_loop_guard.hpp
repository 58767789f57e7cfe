// Counts the runs that did not end in order, so that godwitd does not start again and again into a state that kills it.
//
// A small file beside the journal: the boot's id, then a line for each run that is under way or has ended abnormally,
// with its start in milliseconds of this boot, and " fast" and the time of the end after it when it ended by force in
// flight. A run that ends
// in order takes its line away. When there are too many lines of late, the next run does not begin before a person has
// removed the file or the time has passed; while a vehicle flies it begins in any case, in the end with what flies
// alone. Only this boot counts: power that comes and goes is no crash, and the clock of a boot is never set. The page
// cache outlives the process, so nothing is synced.
//
// Errors: a file that can not be read or written is a sentence and no reason not to start. Thread: one owner, who has
// the journal's lock.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace godwit::daemon {

struct start_limits {
  std::size_t max_abnormal_ends = 100; // 0: any number
  std::chrono::seconds within{600};
};

struct boot_moment {
  std::string boot; // its id
  std::int64_t at_ms = 0;
};

// Source: random(4) (boot_id), clock_gettime(2) (CLOCK_BOOTTIME).
[[nodiscard]] boot_moment this_moment();

struct start_verdict {
  bool may_start = true;
  bool is_reduced = false;  // with vehicle_link, failsafe, executor and ground_port alone
  bool may_end_fast = true; // when an essential actor can not be kept up in flight; else it goes on without it
  std::string sentence;     // why not, or what is wrong with the file; empty: all is well
};

class crash_loop_guard {
public:
  // In flight: after so many abnormal ends a run is reduced.
  static constexpr std::size_t max_whole_in_flight = 10;
  // After one fast end there is no other one for so long.
  static constexpr std::chrono::minutes fast_end_counts{10};

  crash_loop_guard(std::string file, start_limits limits) : file_(std::move(file)), limits_(limits) {}

  // Notes this run, unless it must not begin. IN_FLIGHT: as the journal says.
  [[nodiscard]] start_verdict begin(const boot_moment& now, bool in_flight);
  // Of a run that was noted.
  void end_in_order();
  void end_fast(const boot_moment& now);

private:
  struct run {
    std::int64_t began_ms = 0;
    std::int64_t ended_fast_ms = 0; // 0: it did not
    [[nodiscard]] std::int64_t last_ms() const { return ended_fast_ms != 0 ? ended_fast_ms : began_ms; }
  };

  [[nodiscard]] start_verdict judge(const boot_moment& now, bool in_flight) const;
  [[nodiscard]] std::size_t ended_within(const boot_moment& now) const;
  [[nodiscard]] std::string count_of(std::size_t ended) const;
  [[nodiscard]] std::vector<run> read(const boot_moment& now) const;
  [[nodiscard]] bool write() const;

  const std::string file_;
  const start_limits limits_;
  std::string boot_;
  std::vector<run> runs_; // this one last; at most max_kept
};

} // namespace godwit::daemon
