// The durable memory of all actors: one writer, group commit, recovery in order.
//
// An actor hands over a journal_write and goes on; its effects wait until `done` is called. Writes of one actor commit
// in the order of submission. Writes that wait together share one transaction and one fdatasync.
//
// `recover` stands in the same queue as the writes: its answer contains all that was submitted for this actor before
// it, whether committed or (while the disk refuses to write) still waiting. From then on, writes of an older
// incarnation of this actor are refused.
//
// Implementations: sqlite_journal (a file, a writer thread), simulated_journal (tests; virtual time, kill at any step).
// Thread: every function may be called from any thread. Nothing here blocks on the disk.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <tl/expected.hpp>

#include "runtime/journal/records.hpp"

namespace godwit::runtime {

struct journal_status {
  bool failing = false;      // the last commit failed, the writer keeps trying
  std::string reason;        // sentence for people while failing
  std::uint64_t commits = 0; // transactions that reached the disk
  std::uint64_t writes = 0;  // journal_writes in them
  std::uint64_t events = 0;  // events in them
  std::uint64_t retries = 0; // commits tried again after an error
  std::uint64_t refused = 0; // queue_full and stale_incarnation
  std::uint64_t queued = 0;  // writes that wait now
  double fill = 0;           // of the bound on what waits: 0 = empty, 1 = refuses; see io::sqlite::nearly_full
  std::uint64_t run = 0;     // how many times this journal was opened for writing, this time included
};

class journal {
public:
  using recovered_callback = std::function<void(tl::expected<recovered, journal_error>)>;

  journal() = default;
  journal(const journal&) = delete;
  journal& operator=(const journal&) = delete;
  virtual ~journal() = default;

  // Takes the write, or says why not (queue_full, stale_incarnation, closed); then nothing of it will happen, and WRITE
  // is as it was.
  [[nodiscard]] virtual tl::expected<void, journal_error> submit(journal_write&& write) = 0;

  // Calls back once, on the writer thread.
  virtual void recover(std::string actor, std::uint64_t incarnation, recovered_callback callback) = 0;

  [[nodiscard]] virtual journal_status status() const = 0;
};

} // namespace godwit::runtime
