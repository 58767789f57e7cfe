// How a stable address treats its mail, and what it has counted. Thread: plain values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace godwit::runtime {

// What happens to the mail of an incarnation that crashes.
enum class on_crash {
  lose,      // streams: stale data is worse than none
  redeliver, // commands and events
};

struct address_options {
  std::string name;
  on_crash policy = on_crash::redeliver;
  std::size_t mailbox_bound = 100'000; // messages waiting at the incarnation
  std::size_t parking_bound = 10'000;  // messages arriving while there is no incarnation
  std::uint64_t run = 1;               // of the journal: answers that an earlier process owes are nobody's in this one
};

// Message ids of one process are not those of another: 268 million for each sender before they meet those of the next.
constexpr std::uint64_t ids_before_run(std::uint64_t run) {
  constexpr unsigned bits_in_a_run = 28;
  constexpr std::uint64_t runs = std::uint64_t{1} << (41U - bits_in_a_run);
  return ((run == 0 ? 0 : run - 1) % runs) << bits_in_a_run;
}

// A message is put back twice, and given up at the third crash, when its dead letter is with the journal.
inline constexpr int max_crashes = 3;

// Requests of one actor whose answer is still to come.
inline constexpr std::size_t max_waiting_answers = 10'000;

// Confirmations of durable effects, kept while there is no incarnation to hear them. One too many is forgotten: its
// effect goes out once more after the next crash, and is dropped as seen.
inline constexpr std::size_t max_confirmations = 10'000;

struct address_counters {
  std::uint64_t accepted = 0;      // taken by the address
  std::uint64_t handled = 0;       // the handler returned
  std::uint64_t crashes = 0;       // incarnations that ended by an exception or a kill
  std::uint64_t requeued = 0;      // messages put back after crashing their handler
  std::uint64_t dead_lettered = 0; // messages given up after max_crashes
  std::uint64_t repeated = 0;      // durable effects that were seen before
  std::uint64_t lost = 0;          // given up by policy lose, or handled by an incarnation that had been replaced
  std::uint64_t refused = 0;       // over a bound, or after the end; asks also while the actor is away
  std::uint64_t dropped = 0;       // tells while the actor is away
  std::uint64_t not_accepted = 0;  // messages that the mailbox does not have, and answers of a wrong type
};

} // namespace godwit::runtime
