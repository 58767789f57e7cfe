// The address of an actor that outlives its incarnations: handles, timers and queued mail stay good across a crash.
//
// Messages are forwarded to the living incarnation in the sender's own thread. Between two incarnations they are
// parked, up to a bound. What belongs to the actor but not to an incarnation lives here too: message ids, how often a
// message has crashed its handler, which durable effects were seen, which requests still wait for an answer, and the
// counters.
//
//   sender ──tell──> stable_address ──> incarnation 3
//                        │   ▲ mail that was not handled, with the message that crashed in front
//                     parked ┘
//
// Nothing is dropped silently: `lost` counts mail given up by policy `lose`, `refused` what ran over a bound,
// `dead_lettered` what crashed its handler max_crashes times. A request that is dropped is answered with an error at
// once. Thread: any; no actor reference is released and no foreign code is called while the lock is held.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <string>
#include <vector>

#include <caf/all.hpp>

#include "runtime/journal/records.hpp"
#include "runtime/mail.hpp"

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
};

// A message is handled at most this often: put back twice, given up at the third crash.
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
  std::uint64_t put_back = 0;      // messages put back after crashing their handler
  std::uint64_t dead_lettered = 0; // messages given up after max_crashes
  std::uint64_t repeated = 0;      // durable effects that were seen before
  std::uint64_t lost = 0;          // given up by policy lose, or handled by an incarnation that had been replaced
  std::uint64_t refused = 0;       // over a bound, or after the end
  std::uint64_t not_accepted = 0;  // messages that the mailbox type does not have
};

// Pings and the like: not mail.
[[nodiscard]] bool is_runtime_message(const caf::mailbox_element& element);

class stable_address final : public caf::monitorable_actor {
public:
  stable_address(caf::actor_config& config, std::uint32_t number, address_options options);

  // -- senders ------------------------------------------------------------------------------------
  void enqueue(caf::mailbox_element_ptr element, caf::execution_unit* context) override;
  const char* name() const override { return options_.name.c_str(); }

  // -- the incarnation ----------------------------------------------------------------------------
  [[nodiscard]] std::uint32_t number() const { return number_; }
  [[nodiscard]] const std::string& actor_name() const { return options_.name; }
  [[nodiscard]] on_crash policy() const { return options_.policy; }

  // A fresh message id: the address's number and a count, below 2^53.
  std::uint64_t next_id() { return (std::uint64_t{number_} << 41U) | ids_.fetch_add(1, std::memory_order_relaxed); }

  // False once the incarnation has been replaced.
  [[nodiscard]] bool is_current(std::uint64_t incarnation) const {
    return incarnation_.load(std::memory_order_acquire) == incarnation;
  }

  // The message crashed its handler once more; true: put it back, false: give it up.
  [[nodiscard]] bool may_retry(std::uint64_t message_id, int& crashes_so_far);
  void settled(std::uint64_t message_id);

  // One message was taken from the incarnation's mailbox; handled, or not and why (null: it crashed and was counted as
  // such).
  void count_handled() { taken_.fetch_add(1, std::memory_order_relaxed); }
  void count_unhandled(std::uint64_t address_counters::*why);
  void count_runtime_messages(std::size_t n); // pings and the like, which are nobody's mail

  // Durable effects: has this one of SOURCE been seen? mark() remembers it, restore() takes what the journal kept.
  [[nodiscard]] bool has_seen(std::uint32_t source, effect_id id) const;
  void mark_seen(std::uint32_t source, effect_id id);

  // Requests that will be answered later. take_requester gives each only once; empty when nobody waits any more.
  struct requester {
    caf::strong_actor_ptr who;
    caf::message_id mid;
  };
  // False: max_waiting_answers wait already; the request was refused, answered with not_taken and counted.
  [[nodiscard]] bool expect_answer(std::uint64_t message_id, requester r);
  [[nodiscard]] requester take_requester(std::uint64_t message_id);
  [[nodiscard]] std::optional<caf::message_id> awaited_mid(std::uint64_t message_id) const;
  // Answers every request that waited for this INCARNATION or an earlier one with "outcome unknown", except those in
  // KEEP.
  void give_up_answers(const std::vector<std::uint64_t>& keep, std::uint64_t incarnation);

  // The dying incarnation goes in two steps: from park_from_now() on mail is parked and none reaches its mailbox any
  // more; then it empties its mailbox and gives back what it had not handled, oldest first. The first PUT_BACK of it
  // were counted as taken.
  void park_from_now(const caf::actor_control_block* dying, std::uint64_t incarnation);
  void give_back(std::vector<caf::mailbox_element_ptr> mail, std::size_t put_back);
  void note_crash(std::string reason);
  void note_beyond_restart() { beyond_restart_.store(true); } // its durable state can not be read
  [[nodiscard]] bool is_beyond_restart() const { return beyond_restart_.load(); }
  [[nodiscard]] std::string last_crash() const;

  // -- the guardian -------------------------------------------------------------------------------
  [[nodiscard]] std::uint64_t begin_incarnation(); // its number, from 1
  void bind(caf::strong_actor_ptr incarnation, caf::execution_unit* context);
  // Gives up an incarnation that does not answer: mail is parked from now on. Returns how many messages are stranded in
  // it.
  std::size_t abandon();
  [[nodiscard]] bool is_running() const; // there is one
  bool kill();                           // ends the incarnation between two messages; false: there is none
  void close();                          // final: everything waiting is answered with an error and counted as refused

  // -- anybody ------------------------------------------------------------------------------------
  [[nodiscard]] address_counters counters() const;
  [[nodiscard]] std::size_t parked() const;

private:
  struct waiting_answer {
    requester from;
    std::uint64_t incarnation = 0; // the one that took the request
  };

  void keep_for_next(caf::mailbox_element_ptr element); // under the lock
  void refuse(caf::mailbox_element_ptr element);
  void forward_again(std::vector<caf::mailbox_element_ptr>& mail); // under the lock
  // The bound is for mail: without the runtime's own messages, whose number is bounded by what they answer, a busy
  // actor would miss its pings and not hear that its effects are durable.
  [[nodiscard]] bool has_room_for(const caf::mailbox_element& element) const {
    return !mailbox_full() || is_runtime_message(element);
  }
  [[nodiscard]] bool mailbox_full() const {
    return enqueued_.load(std::memory_order_relaxed) - taken_.load(std::memory_order_relaxed) >= options_.mailbox_bound;
  }

  const std::uint32_t number_;
  const address_options options_;

  mutable std::shared_mutex mutex_; // shared: forwarding; unique: everything that changes what is below
  caf::strong_actor_ptr target_;
  std::deque<caf::mailbox_element_ptr> parked_;
  std::size_t arrived_while_parked_ = 0;
  std::int64_t durable_upto_ = 0;                       // told by the journal while there was no incarnation to hear it
  std::vector<caf::mailbox_element_ptr> confirmations_; // effect_taken, likewise; at most max_confirmations
  bool closed_ = false;
  std::string last_crash_;
  std::map<std::uint64_t, int> crashes_of_;                 // by message id; only messages in trouble
  std::map<std::uint32_t, effect_id> seen_;                 // by source
  std::map<std::uint64_t, waiting_answer> waiting_answers_; // by message id of the request
  std::uint64_t last_ended_ = 0;                            // incarnation; one may end before it is bound
  address_counters counters_;                               // without what the atomics below count
  std::uint64_t forwarded_again_ = 0;                       // of enqueued_: mail that had been parked or put back
  std::uint64_t runtime_messages_ = 0;                      // of enqueued_ and taken_
  std::uint64_t unhandled_ = 0;                             // of taken_: whatever did not end as handled
  std::vector<caf::strong_actor_ptr> stranded_;             // incarnations whose handler never returned

  std::atomic<std::uint64_t> incarnation_{0};
  std::atomic<std::uint64_t> ids_{1};
  std::atomic<bool> trouble_{false}; // crashes_of_ is not empty
  std::atomic<bool> beyond_restart_{false};
  alignas(64) std::atomic<std::uint64_t> enqueued_{0}; // written by senders
  alignas(64) std::atomic<std::uint64_t> taken_{0};    // written by the incarnation
};

using stable_address_ptr = caf::intrusive_ptr<stable_address>;

// Makes an address in SYSTEM; `caf::actor_cast<Handle>(result)` is the handle for others.
[[nodiscard]] caf::strong_actor_ptr make_stable_address(caf::actor_system& system, std::uint32_t number,
                                                        address_options options);

[[nodiscard]] inline stable_address& address_of(const caf::strong_actor_ptr& pointer) {
  return static_cast<stable_address&>(*pointer->get());
}

} // namespace godwit::runtime
