// The address of an actor that outlives its incarnations: handles, timers and queued mail stay good across a crash.
//
// Messages are forwarded to the living incarnation in the sender's own thread. Between two incarnations they are
// parked, up to a bound. While the actor is away (not wanted, or given up) only durable effects are: nobody answers an
// ask, and what a tell said is old when the actor is back. What belongs to the actor but not to an incarnation lives
// here too: message ids, how often a message has crashed its handler, which durable effects were seen, which requests
// still wait for an answer, and the counters.
//
//   sender ──tell──> stable_address ──> incarnation 3
//                        │   ▲ mail that was not handled, with the message that crashed in front
//                     parked ┘
//
// Nothing is dropped silently: `lost` counts mail given up by policy `lose`, `refused` what ran over a bound, `dropped`
// tells to an actor that is away,
// `dead_lettered` what crashed its handler, or led to a write that can never commit, max_crashes times. A request that
// is dropped is answered with an error at once. Thread: any; no actor reference is released and no foreign code is
// called while the lock is held.
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

#include "runtime/address/address_options.hpp"
#include "runtime/address/disk_waiters.hpp"
#include "runtime/address/unseen_effects.hpp"
#include "runtime/caf_mail.hpp"
#include "runtime/journal/records.hpp"

namespace godwit::runtime {

// Pings and the like: not mail.
[[nodiscard]] bool is_runtime_message(const envelope& m);
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
  std::uint64_t next_id() { return id_base_ | ids_.fetch_add(1, std::memory_order_relaxed); }

  // The next id is ID, as this address had it in a recorded process. For an actor that is replayed.
  void continue_ids_from(std::uint64_t id) {
    id_base_ = id & ~count_mask;
    ids_.store(id & count_mask);
  }

  // False once the incarnation has been replaced.
  [[nodiscard]] bool is_current(std::uint64_t incarnation) const {
    return incarnation_.load(std::memory_order_acquire) == incarnation;
  }

  // The message crashed its handler once more; true: put it back, false: give it up.
  [[nodiscard]] bool may_retry(std::uint64_t message_id, int& crashes_so_far);
  // Then one of these: its dead letter is with the journal, or the journal took none and it is put back once more.
  void given_up(std::uint64_t message_id);
  void put_back_all_the_same();
  void resolved(std::uint64_t message_id);

  // One message was taken from the incarnation's mailbox; handled, or not and why (null: it crashed and was counted as
  // such).
  void begins_handling(std::uint64_t message_id) { in_hand_.store(message_id, std::memory_order_relaxed); }
  void count_handled() { taken_.fetch_add(1, std::memory_order_relaxed); }
  void count_unhandled(std::uint64_t address_counters::*why);
  void count_runtime_messages(std::size_t n); // pings and the like, which are nobody's mail
  void count_wrong_answer();                  // of another type than was asked for

  // Durable effects: has this one of SOURCE been seen? mark() remembers it, restore() takes what the journal kept.
  [[nodiscard]] bool has_seen(std::uint32_t source, effect_id id) const;
  // Returns the mark before.
  effect_id mark_seen(std::uint32_t source, effect_id id);

  // Writes of this actor on their way to the disk: submitted() notes one and the message that led to it, confirm()
  // sends TAKEN when all that was noted so far is on the disk, written() says how far it is.
  void submitted(unwritten_message message);
  void keep_from_return(std::uint64_t message_id);
  void confirm(confirmation taken, caf::execution_unit* context);
  void written(std::int64_t upto);
  // Nothing of INCARNATION above UPTO will ever be written: what led to that and to later writes is counted as not
  // handled and comes back, oldest first. Effects among it count as not seen again.
  [[nodiscard]] std::deque<unwritten_message> take_unwritten(std::uint64_t incarnation, std::int64_t upto);
  // What came back because the journal said so meanwhile.
  [[nodiscard]] std::deque<unwritten_message> take_returned();

  // Requests that will be answered later. take_requester gives each only once; empty when nobody waits any more.
  struct requester {
    caf::strong_actor_ptr who;
    caf::message_id mid;
    void fail(caf::error why) const; // answers it with an error, if somebody waits
  };
  // Answers R, if there is one, with an error: this actor's name and WHAT.
  void answer_failure(const requester& r, caf::sec code, const std::string& what) const;
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
  void give_back(std::vector<caf::mailbox_element_ptr> mail, std::size_t requeued);
  void note_crash(std::string reason);
  void note_beyond_restart() { beyond_restart_.store(true); } // its durable state can not be read
  [[nodiscard]] bool is_beyond_restart() const { return beyond_restart_.load(); }
  [[nodiscard]] std::string last_crash() const;

  // -- the guardian -------------------------------------------------------------------------------
  [[nodiscard]] std::uint64_t begin_incarnation(); // its number, from 1
  void bind(caf::strong_actor_ptr incarnation, caf::execution_unit* context);
  // Gives up an incarnation that does not answer: mail is parked from now on, after the durable effects that it had
  // not handled. Returns how many other messages are stranded in it.
  std::size_t abandon();
  bool kill(); // ends the incarnation between two messages; false: there is none
  // The actor is not wanted or was given up: what waits is dropped or refused, but for durable effects. It is back when
  // its next incarnation begins.
  void go_away();
  void close(); // final: everything waiting is answered with an error and counted as refused

  // -- anybody ------------------------------------------------------------------------------------
  [[nodiscard]] address_counters counters() const;
  [[nodiscard]] std::size_t waiting() const; // in the mailbox of the incarnation, and parked

private:
  struct waiting_answer {
    requester from;
    std::uint64_t incarnation = 0; // the one that took the request
  };

  void hand_over(caf::mailbox_element_ptr element, caf::execution_unit* context); // under the lock, to the target
  void keep_for_next(caf::mailbox_element_ptr element);                           // under the lock
  // Nobody will look at MAIL but, later, at its durable effects: these are left in it.
  std::vector<caf::mailbox_element_ptr>
  sort_out(std::deque<caf::mailbox_element_ptr>& mail); // under it; what to refuse
  void take_back_unwritten(caf::mailbox_element_ptr failed, caf::execution_unit* context);
  [[nodiscard]] std::deque<unwritten_message> unwritten_of(std::uint64_t incarnation, std::int64_t upto); // under it
  void refuse(caf::mailbox_element_ptr element);
  [[nodiscard]] caf::error is_down() const;
  void forward_again(std::vector<caf::mailbox_element_ptr>& mail); // under the lock
  // The bounds are for the mail of others. Without the runtime's own messages, whose number is bounded by what they
  // answer, a busy actor would miss its pings and not hear that its effects are durable; without its own timers, each
  // of which the actor sets when the last has come, it would never tick again.
  [[nodiscard]] bool has_room_for(const caf::mailbox_element& element) const {
    return !mailbox_full() || is_own(element) || is_runtime_message(element);
  }
  [[nodiscard]] bool is_own(const caf::mailbox_element& element) const { return element.sender.get() == ctrl(); }
  [[nodiscard]] bool mailbox_full() const {
    return enqueued_.load(std::memory_order_relaxed) - taken_.load(std::memory_order_relaxed) >= options_.mailbox_bound;
  }

  static constexpr unsigned count_bits = 41;
  static constexpr std::uint64_t count_mask = (std::uint64_t{1} << count_bits) - 1;

  const std::uint32_t number_;
  const address_options options_;
  std::uint64_t id_base_; // written again for a replay only, which has one thread

  mutable std::shared_mutex mutex_; // shared: forwarding; unique: everything that changes what is below
  caf::strong_actor_ptr target_;
  std::deque<caf::mailbox_element_ptr> parked_;
  std::size_t arrived_while_parked_ = 0;
  std::int64_t durable_upto_ = 0;         // told by the journal while there was no incarnation to hear it
  caf::mailbox_element_ptr write_failed_; // while there was no incarnation to hear it
  caf::mailbox_element_ptr retry_write_;  // likewise
  disk_waiters waiters_;
  std::deque<unwritten_message> returned_; // a write of theirs can never commit; the incarnation has not seen to it yet
  std::vector<caf::mailbox_element_ptr> confirmations_; // effect_taken, likewise; at most max_confirmations
  bool closed_ = false;
  bool away_ = false;
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
  unseen_effects unseen_;                                   // of the target

  std::atomic<std::uint64_t> incarnation_{0};
  std::atomic<std::uint64_t> ids_;
  std::atomic<bool> trouble_{false}; // crashes_of_ is not empty
  std::atomic<bool> beyond_restart_{false};
  alignas(64) std::atomic<std::uint64_t> enqueued_{0}; // written by senders
  alignas(64) std::atomic<std::uint64_t> taken_{0};    // written by the incarnation
  std::atomic<std::uint64_t> in_hand_{0};              // likewise; id of the message that it handled last
};

using stable_address_ptr = caf::intrusive_ptr<stable_address>;

// Makes an address in SYSTEM.
[[nodiscard]] caf::strong_actor_ptr make_stable_address(caf::actor_system& system, std::uint32_t number,
                                                        address_options options);

[[nodiscard]] inline stable_address& address_of(const caf::strong_actor_ptr& pointer) {
  return static_cast<stable_address&>(*pointer->get());
}
[[nodiscard]] inline stable_address& address_of(const actor_ref& ref) {
  return static_cast<stable_address&>(*ref.get()->get());
}

} // namespace godwit::runtime
