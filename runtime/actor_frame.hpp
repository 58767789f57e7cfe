// The part of every actor that does not depend on its mailbox: what happens around a handler. Actors derive from
// actor_base or durable_actor, never from this directly.
//
// The rules that it keeps:
// - Any exception ends the incarnation. With policy redeliver the message is put back in front of the others, up to
//   max_crashes.
// - All that a handler sends (tell, ask, tell_after, its answer) is held back until it returns. A handler that throws
//   has sent nothing, so handling the message again sends nothing twice. at_end() does the same for calls to the world.
// - A durable effect is confirmed to its sender when all that the receiver has decided is on the disk.
// - A write that can never commit ends the incarnation; what led to it and to later ones is put back.
// - While the journal takes nothing more, asks are refused, streams dropped, and the rest waits in order.
// - Others hold the stable address, never the incarnation; timers go to the address too.
// - Each delivery is one trace record with the id of the message that caused it.
// - An incarnation that was replaced while its handler hung sends nothing when it wakes up.
// - A message of a type that the mailbox does not have, and an answer of another type than was asked for, are counted
//   (not_accepted), turn the actor's health yellow and are refused; they reach no handler.
// Thread: an actor is never run by two threads at once; its members need no lock.
#pragma once

#include <algorithm>
#include <chrono>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/ask_error.hpp"
#include "runtime/clock.hpp"
#include "runtime/condition.hpp"
#include "runtime/envelope.hpp"
#include "runtime/seam.hpp"
#include "runtime/services.hpp"
#include "runtime/trace/trace_sink.hpp"

namespace godwit::runtime {

// The handlers of an actor, one for each message of its mailbox: looked up at run time by the address of the message's
// type, checked for completeness when they are compiled. Thread: the actor's.
struct handler_row {
  const message_type* type = nullptr;
  std::function<void(const envelope&)> call;
};

// A handler for WORD; made by actor_base::on and on_deferred.
template <class Signature>
struct handler {
  handler_row row;
};

class handler_table {
public:
  handler_table() = default;

  // Null: this actor does not take the type.
  [[nodiscard]] const handler_row* find(const message_type* type) const {
    const auto found = std::ranges::find(rows_, type, &handler_row::type);
    return found == rows_.end() ? nullptr : &*found;
  }

  // By the name of the type.
  [[nodiscard]] const message_type* type_named(std::string_view name) const {
    const auto found = std::ranges::find_if(rows_, [&](const auto& each) { return each.type->name == name; });
    return found == rows_.end() ? nullptr : found->type;
  }

protected:
  explicit handler_table(std::vector<handler_row> rows) : rows_(std::move(rows)) {}

private:
  std::vector<handler_row> rows_;
};

namespace detail {

template <class Signature, class... Signatures>
inline constexpr int count_of = (0 + ... + (std::same_as<Signature, Signatures> ? 1 : 0));

} // namespace detail

template <class Mailbox>
class handlers_of;

template <class... Signatures>
class handlers_of<mailbox<Signatures...>> : public handler_table {
public:
  template <class... Given>
  // NOLINTNEXTLINE(google-explicit-constructor): `return {on<a>(...), on<b>(...)};`
  handlers_of(handler<Given>... given) : handler_table(std::vector<handler_row>{std::move(given.row)...}) {
    static_assert(((detail::count_of<Signatures, Given...> == 1) && ...),
                  "each message of the mailbox has exactly one handler");
    static_assert(sizeof...(Signatures) == sizeof...(Given), "a handler answers to no message of the mailbox");
  }
};

} // namespace godwit::runtime

namespace caf {
class mailbox_element;
}

namespace godwit::runtime {

class stable_address;
struct durable;
struct write_failed;
struct address_counters;

class actor_frame {
public:
  actor_frame(const actor_frame&) = delete;
  actor_frame& operator=(const actor_frame&) = delete;
  virtual ~actor_frame();

  [[nodiscard]] const std::string& actor_name() const;
  [[nodiscard]] std::uint64_t incarnation_number() const { return context_.number; }

protected:
  explicit actor_frame(spawn_context context);

  // Called once, before the first message.
  virtual void start() = 0;

  [[nodiscard]] stable_address& address() const;
  [[nodiscard]] const services& outside() const { return *context_.outside; }
  // The time, the same in all of a handler and recorded with it, so that a replay decides by the time by which it was
  // decided.
  struct moment {
    std::int64_t monotonic_ns = 0;
    std::int64_t wall_ns = 0;
  };
  [[nodiscard]] moment handler_time() const;
  [[nodiscard]] std::int64_t now_ns() const { return handler_time().monotonic_ns; }
  [[nodiscard]] std::int64_t wall_ns() const { return handler_time().wall_ns; }
  [[nodiscard]] const header& current() const { return current_; } // of the message being handled
  [[nodiscard]] const spawn_context& context() const { return context_; }
  [[nodiscard]] recovered take_restored() { return std::exchange(context_.restored, {}); }

  void set_handlers(handler_table table) { handlers_ = std::move(table); }
  void report_up();
  // Posts it on the health board when it has changed.
  void show_health(condition how);
  // Calls on_deadline() at DUE_NS (monotonic) or soon after. One is under way at a time: an earlier one takes the place
  // of a later one, and a later one is not heard before the earlier has come. Nothing is done for never_due.
  static constexpr std::int64_t never_due = std::numeric_limits<std::int64_t>::max();
  void wake_at(std::int64_t due_ns);
  virtual void on_deadline();
  void hit(crash_point point);

  // -- sending ------------------------------------------------------------------------------------
  void send(const actor_ref& to, const message_type& type, message_body body);
  void send_after(std::chrono::nanoseconds delay, const actor_ref& to, const message_type& type, message_body body);
  void request(const actor_ref& to, std::chrono::nanoseconds timeout, const message_type& type, message_body body,
               const message_type& answer_type, std::function<void(const envelope&)> on_answer,
               const std::function<void(const ask_error&)>& on_error);
  // Answers the request being handled.
  void answer_now(const message_type& type, message_body body);
  // Notes that the request being handled is answered later; false: too many wait, it was refused.
  [[nodiscard]] bool defer_answer();
  // Answers a request that was deferred. A late answer to somebody who waits no more is dropped.
  void answer_deferred(std::uint64_t request_id, const message_type& type, message_body body);
  // Sends what SEND tells right now instead of when the handler returns.
  void send_at_once(const std::function<void()>& send);
  void send_held();

  // Runs DO when the handler has returned and what it decided is with the journal; never when it throws. For calls to
  // the world outside that a repetition of the message would repeat.
  void at_end(std::function<void()> run) { ends_.push_back(std::move(run)); }
  // Records what is done beside messages: a few words, and the hash of what was handed over (content_hash.hpp). Both
  // need not be made where nobody records.
  void note_call(std::string what, std::uint64_t hash);
  [[nodiscard]] bool is_recorded() const { return is_traced() || outside().replayed != nullptr; }
  // What this message does can not be taken back: from here on it is not put back.
  void mark_committed();

  // -- for durable_actor --------------------------------------------------------------------------
  // Hands what the handler decided to the journal, as one write. Throws when that can not be.
  virtual void submit_decisions();
  // What the handler sent is on its way.
  virtual void handler_has_ended();
  // False: the journal is behind by its bound, and so is this actor.
  [[nodiscard]] virtual bool takes_mail() const;
  virtual void retry_refused_write();
  void retry_write_after(std::chrono::nanoseconds delay);
  // The handler's write, with events up to EVENT, is with the journal, or kept to be offered again.
  void note_submitted(std::int64_t event);
  // Events up to here the journal has taken; none of what is above outlives this incarnation.
  [[nodiscard]] virtual std::int64_t submitted_upto() const;
  // Events up to here are on the disk.
  void note_written(std::int64_t upto);
  // Records VALUE, which came in beside the mailbox while the current message is handled.
  void record_observed(const message_type& type, const void* value);
  // Records what this incarnation was restored from, as JSON.
  void record_restored(const std::string& document);
  [[nodiscard]] bool is_traced() const { return outside().trace != nullptr; }
  // Runs F as the handling of M, a message of the runtime's own: held back, traced, but never put back.
  void run_internal(const envelope& m, const std::function<void()>& f);
  template <class T>
  [[nodiscard]] envelope own_message(T body) {
    return own_message_of(type_of<T>(), message_body::of(std::move(body)));
  }
  // For journal_write::done: tells this address, on whichever incarnation then lives, how the write of EVENT went.
  [[nodiscard]] std::function<void(const commit_result&)> tell_me_when_durable(std::int64_t event) const;
  void mark_seen(std::uint32_t source, effect_id id);
  // What is told while SEND runs carries the id EFFECT; returns the numbers of the actors that it was told to.
  [[nodiscard]] std::vector<std::uint32_t> send_as_effect(effect_id effect, const std::function<void()>& send);
  // Letting effects out once they are on the disk, and the requests whose answers are.
  virtual void durable_upto(std::int64_t event);
  virtual void effect_taken_by(std::uint32_t receiver, effect_id id);
  virtual void forget_what_is_gated(); // a write failed for good: none of it will become durable
  [[nodiscard]] virtual std::vector<std::uint64_t> durable_answers() const;

private:
  friend class incarnation;
  struct held_message;
  struct delivery;
  struct kept_mail;

  // -- what the incarnation hands over --------------------------------------------------------------
  void receive(const envelope& m);
  void receive_unknown();
  void leave();
  [[nodiscard]] std::string crash_reason(std::exception_ptr& thrown);

  [[nodiscard]] delivery begin(const header& head, caf::mailbox_element& element);
  [[nodiscard]] delivery begin_internal(const header& head);
  [[nodiscard]] bool is_repetition(const header& head) const;
  void deliver(delivery d, const envelope& m, const std::function<void(const envelope&)>& handle);
  void hear(const envelope& due); // a deadline
  void finish_handler();
  void keep_off(const envelope& m);
  void take_kept();
  void receive_answer(const envelope& m, const message_type& expected,
                      const std::function<void(const envelope&)>& on_answer,
                      const std::function<void(const ask_error&)>& on_error);
  void receive_failure(const header& asked, ask_error why, const std::function<void(const ask_error&)>& on_error);
  [[nodiscard]] bool handle_runtime_message(const envelope& m);
  void refuse_unknown(const envelope& m);
  void end_handled(const delivery& d, const envelope& m);
  void end_unhandled(const delivery& d, const envelope& m, outcome how, std::uint64_t address_counters::*why);
  void end_fenced(const delivery& d, const envelope& m);
  void end_crashed(const delivery& d, const envelope& m);
  void end_for_failed_write(const write_failed& why);
  void record(const delivery& d, const envelope& m, outcome how);
  [[nodiscard]] trace_entry entry_without_id() const;
  void confirm_effect(const delivery& d);
  [[nodiscard]] bool write_dead_letter(const envelope& m, int crashes, const std::string& reason);
  [[nodiscard]] header stamp();
  [[nodiscard]] envelope own_message_of(const message_type& type, message_body body);
  void hold(held_message message);
  void forget_held();

  spawn_context context_;
  handler_table handlers_;
  header current_;
  effect_id sending_effect_;                    // stamped into what is told while a durable effect is sent
  std::vector<std::uint32_t> effect_receivers_; // whom it was told to
  const delivery* delivering_ = nullptr;
  const envelope* handling_ = nullptr;
  std::vector<held_message> held_;
  std::vector<std::function<void()>> ends_;
  std::vector<kept_mail> requeued_; // by a crash, for the next incarnation
  std::vector<kept_mail> kept_;     // not taken yet, because the journal takes nothing
  std::optional<condition> shown_;
  std::optional<std::int64_t> deadline_ns_; // that is under way
  std::uint64_t deadline_number_ = 0;
  bool in_handler_ = false;
  mutable std::optional<moment> handler_time_; // of the handler under way, when it was asked for
  bool committed_ = false;
  bool has_submitted_ = false;
  bool is_done_for_good_ = false; // by mark_committed()
  bool is_broken_ = false;        // a write of this incarnation can never commit
  bool left_ = false;
};

} // namespace godwit::runtime
