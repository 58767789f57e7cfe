// An actor whose decisions survive: a pure core, and around it the order "decide, commit, dispatch, mark released".
//
//   struct core {
//     using state = ...;                          // a field table and `static constexpr int version`
//     using event = std::variant<moved, reset>;   // what has happened: messages with field tables
//     using effect = std::variant<milestone, reset_done>;
//     // Puts an event into the state; what comes of it. No clock, no I/O, no CAF.
//     static std::vector<effect> apply(state&, const event&, std::int64_t at_ns);
//     // What a new incarnation has to start again.
//     static std::vector<effect> resume(const state&, std::int64_t now_ns);
//     // Names of events and effects that earlier versions wrote and that mean nothing now; only if there are such.
//     static constexpr std::array<std::string_view, N> retired{...};
//     // Only if version > 1.
//     static tl::expected<nlohmann::json, std::string> migrate(nlohmann::json state, int from_version);
//   };
//
// commit() puts an event into the state in memory at once; a handler may do so any number of times. When it returns,
// all its events, effects and rows go to the journal as one write; when it throws, the incarnation ends and nothing of
// them has been. on_event<E>() is a handler that commits a tell, on_request<Q, R>() one that commits an ask, answered
// by the effect R. Effects go out through dispatch(), each by the kind that its type says (effect_kind.hpp);
// after_commit() does the same for anything else. An answer that is returned by a handler (on<Q>) goes out with it and
// does not wait.
//
// After a crash the state is the newest snapshot with the later events applied again, and every durable effect not
// marked released goes out again with the same id: receivers drop what they have seen. `at_ns` is wall time and part of
// the event, so that applying it again gives the same. One effect is at most one message to each receiver. stage() lets
// a shell turn an effect into rows of its own tables or of the outbox, in the same transaction.
//
// A failing disk ends nothing: writes wait, and so does what is to go out after them. When the journal takes nothing,
// the actor keeps one write and offers it again every write_retry; after its own bounds it takes no mail that is not
// its own (actor_frame.hpp). Thread: as actor_base.
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "runtime/actor_base.hpp"
#include "runtime/assert.hpp"
#include "runtime/effect_kind.hpp"
#include "runtime/internal_messages.hpp"
#include "runtime/journal/records.hpp"
#include "runtime/planted_bug.hpp"
#include "runtime/stored_state.hpp"

namespace godwit::runtime {

// A state is written in full after so many events, or so many bytes of them, so that a recovery reads little.
inline constexpr int events_per_snapshot = 100;
inline constexpr std::size_t bytes_per_snapshot = std::size_t{256} * 1024;

// Effects of one actor that wait for the disk or for a receiver.
inline constexpr std::size_t max_unreleased_effects = 10'000;
// Events of one actor that are not on the disk.
inline constexpr std::int64_t max_unwritten_events = 10'000;
// Bytes of one actor that a full journal did not take, without its snapshot.
inline constexpr std::size_t max_refused_bytes = std::size_t{4} * 1024 * 1024;
inline constexpr std::chrono::milliseconds write_retry{100};

template <class Mailbox, class Core>
class durable_actor : public actor_base<Mailbox> {
public:
  using effect = typename Core::effect;
  using event = typename Core::event;
  using state = typename Core::state;
  static constexpr bool is_durable = true;

  explicit durable_actor(spawn_context context) : actor_base<Mailbox>(std::move(context)) {}

protected:
  // Sends what the effect means, when its kind says so and in order; what is told meanwhile carries the effect's id.
  virtual void dispatch(const effect& each) = 0;
  // Adds rows of the actor's own tables, or of the outbox, to the transaction of the event.
  virtual void add_rows(const event& happened, journal_write& write) {
    (void)happened;
    (void)write;
  }
  // True when the effect is nothing but what it adds to the transaction; then it is not kept and not dispatched.
  virtual bool stage(const effect& each, journal_write& write) {
    (void)each;
    (void)write;
    return false;
  }
  // True for an actor that must hear everything whatever the disk does; its effects are bounded by what it is.
  [[nodiscard]] virtual bool goes_on_without_disk() const { return false; }

  [[nodiscard]] const state& current_state() const { return state_; }
  // The journal's queue is full, and what this actor decides is kept to be offered again.
  [[nodiscard]] bool is_refused_by_journal() const { return is_refused_; }

  // Applied to the state when this returns; in the journal when the handler has returned.
  void commit(const event& happened) { commit(happened, {}); }

  // Hands what was decided so far to the journal now, and not when the handler returns: after something that has gone
  // out at once. From here on the message is not put back.
  void write_now() { submit_decisions(); }

  // Runs DO when all that this actor has decided by the end of the handler is on the disk. A crash forgets it.
  void after_commit(std::function<void()> run) { gate_.push_back({.run = std::move(run)}); }

  template <class E>
  auto on_event() {
    return this->template on<E>([this](const E& message) { commit(event(message)); });
  }

  // The core must answer each Q with exactly one effect of type R.
  template <class Q, class R>
  auto on_request() {
    return this->template on_deferred<Q, R>([this](const Q& question, std::uint64_t request_id) {
      commit(event(question), {request_id, alternative_index<effect, R>});
    });
  }

  void start() final {
    const auto restored = this->take_restored();
    restore(restored);
    if (this->is_traced())
      this->record_restored(restored_json(restored, {last_event_, this->wall_ns(), state::version, json_of(state_)}));
    this->run_internal(this->own_message(durable{restored.durable_upto}), [&] {
      this->begin_life();
      for (const auto& each : Core::resume(state_, this->wall_ns()))
        dispatch(each);
    });
    this->note_written(restored.durable_upto);
    durable_upto(restored.durable_upto);
  }

private:
  static constexpr std::int64_t handler_end = -1; // all that is decided until then

  struct gated {
    std::int64_t upto = handler_end; // goes out when events up to here are on the disk
    std::optional<effect> what = {}; // is dispatched; else
    std::function<void()> run = {};  // is run
    effect_id id = {};               // of a durable effect
    std::uint64_t answer_to = 0;     // id of the request, 0 = not an answer
  };

  struct awaited_answer {
    std::uint64_t request_id = 0;
    std::size_t alternative = 0; // which alternative of effect is the answer
  };

  void restore(const recovered& from) {
    submitted_upto_ = from.last_event; // also if what follows throws: the journal has these
    if (from.snapshot)
      state_ = read_state<Core>(this->actor_name(), *from.snapshot);
    for (const auto& each : from.events) {
      ++events_since_snapshot_;
      bytes_since_snapshot_ += each.body.size();
      if (is_retired(each.type))
        continue;
      (void)Core::apply(state_, read_alternative<event>(this->actor_name(), each.type, each.body), each.at_ns);
    }
    last_event_ = from.last_event;
    noted_upto_ = from.last_event;
    for (const auto& each : from.effects)
      restore(each);
    for (const auto& each : from.seen)
      if (const auto source = this->outside().names->number(each.source))
        this->mark_seen(*source, each.upto);
  }

  // An earlier version has kept what is not durable any more.
  void restore(const effect_record& from) {
    if (is_retired(from.type))
      return mark_released({from.id});
    auto what = read_alternative<effect>(this->actor_name(), from.type, from.body);
    if (kind_of(what) != effect_kind::durable)
      return mark_released({from.id});
    gate_.push_back({.upto = from.id.event, .what = std::move(what), .id = from.id, .answer_to = from.answer_to});
  }

  [[nodiscard]] static bool is_retired(std::string_view type) {
    if constexpr (requires { Core::retired; })
      return std::ranges::find(Core::retired, type) != Core::retired.end();
    return false;
  }

  [[nodiscard]] static effect_kind kind_of(const effect& what) {
    return std::visit([]<class E>(const E&) { return runtime::kind_of<E>; }, what);
  }

  // -- deciding -----------------------------------------------------------------------------------

  void commit(const event& happened, awaited_answer awaited) {
    const auto at_ns = this->wall_ns();
    auto effects = Core::apply(state_, happened, at_ns);
    const auto number = ++last_event_;
    pending_.events.push_back({number, at_ns, alternative_name(happened), alternative_json(happened)});
    bytes_since_snapshot_ += pending_.events.back().body.size();
    ++events_since_snapshot_;
    add_rows(happened, pending_);
    bool answered = awaited.request_id == 0;
    for (std::uint32_t n = 0; n < effects.size(); ++n) {
      const bool is_answer = awaited.request_id != 0 && effects[n].index() == awaited.alternative;
      answered = answered || is_answer;
      decide({number, n}, std::move(effects[n]), is_answer ? awaited.request_id : 0);
    }
    GODWIT_ASSERT(answered, "a core answers each request with exactly one effect of the answer's type");
  }

  void decide(effect_id id, effect what, std::uint64_t answer_to) {
    switch (kind_of(what)) {
    case effect_kind::at_once:
      this->send_at_once([&] { dispatch(what); });
      break;
    case effect_kind::after_commit:
      gate_.push_back({.what = std::move(what), .answer_to = answer_to});
      break;
    case effect_kind::durable:
      if (stage(what, pending_))
        break;
      if (GODWIT_PLANTED(report_before_commit))
        this->send_at_once([&] { dispatch(what); });
      pending_.effects.push_back({id, alternative_name(what), alternative_json(what), answer_to});
      gate_.push_back({.what = std::move(what), .id = id, .answer_to = answer_to});
      break;
    }
  }

  // -- the write ----------------------------------------------------------------------------------

  void submit_decisions() final {
    for (auto each = gate_.rbegin(); each != gate_.rend() && each->upto == handler_end; ++each)
      each->upto = last_event_;
    if (last_event_ == noted_upto_) {
      if (opened_ < gate_.size() && gate_[opened_].upto <= written_upto_)
        this->at_end([this] { open_gate(written_upto_); });
      return;
    }
    if (const auto& head = this->current(); head.effect_event != 0)
      pending_.seen.push_back({this->outside().names->name(head.sender), {head.effect_event, head.effect_n}});
    offer();
    noted_upto_ = last_event_;
    this->note_submitted(last_event_);
    if (!is_refused_)
      this->hit(crash_point::after_commit);
  }

  // The journal takes the write, or this actor keeps it and offers it again; then one snapshot stands for its events.
  void offer() {
    pending_.actor = this->actor_name();
    pending_.incarnation = this->incarnation_number();
    if (is_refused_ || events_since_snapshot_ >= events_per_snapshot || bytes_since_snapshot_ >= bytes_per_snapshot)
      add_snapshot();
    pending_.done = this->tell_me_when_durable(last_event_);
    const auto taken = this->outside().durable->submit(std::move(pending_));
    if (taken) {
      is_refused_ = false;
      submitted_upto_ = last_event_;
      pending_ = {};
      return;
    }
    if (taken.error().code == journal_errc::stale_incarnation)
      throw journal_refused(taken.error());
    if (!std::exchange(is_refused_, true))
      this->retry_write_after(write_retry);
  }

  void add_snapshot() {
    pending_.snapshot = {last_event_, pending_.events.empty() ? this->wall_ns() : pending_.events.back().at_ns,
                         state::version, json_of(state_)};
    events_since_snapshot_ = 0;
    bytes_since_snapshot_ = 0;
    if (is_refused_) // they would only be deleted again
      pending_.events.clear();
  }

  void retry_refused_write() final {
    if (!is_refused_)
      return;
    offer();
    if (is_refused_)
      this->retry_write_after(write_retry);
  }

  [[nodiscard]] bool takes_mail() const final {
    if (goes_on_without_disk())
      return true;
    const auto kept_bytes = [&] {
      return bytes_of(pending_) - (pending_.snapshot ? pending_.snapshot->body.size() : 0);
    };
    const bool is_behind = gate_.size() + sent_.size() >= max_unreleased_effects ||
                           last_event_ - written_upto_ >= max_unwritten_events ||
                           (is_refused_ && kept_bytes() >= max_refused_bytes);
    return !is_behind;
  }

  // -- what goes out after it ---------------------------------------------------------------------

  void durable_upto(std::int64_t upto) final {
    this->note_written(upto); // it may have been written before it was noted; recorded for what does not wait later
    const bool is_news = upto > std::exchange(written_upto_, std::max(written_upto_, upto));
    if (is_news || (!gate_.empty() && gate_.front().upto <= written_upto_))
      this->run_internal(this->own_message(durable{upto}), [this] { open_gate(written_upto_); });
  }

  // Dispatches what waited for events up to UPTO.
  void open_gate(std::int64_t upto) {
    for (; opened_ < gate_.size() && gate_[opened_].upto != handler_end && gate_[opened_].upto <= upto; ++opened_) {
      const auto& each = gate_[opened_]; // stays where it is while others are added
      this->hit(crash_point::before_dispatch);
      if (each.id.event != 0)
        send_durable(each);
      else
        send_volatile(each);
    }
  }

  // It is on its way. What was told to an actor is marked released when that actor has confirmed it, the rest now. A
  // mark that the journal refuses only means that the effect goes out once more after a crash, and is dropped as seen.
  void handler_has_ended() final {
    if (opened_ == 0)
      return;
    gate_.erase(gate_.begin(), gate_.begin() + static_cast<std::ptrdiff_t>(std::exchange(opened_, 0)));
    if (!released_.empty())
      mark_released(std::exchange(released_, {}));
  }

  void send_volatile(const gated& each) {
    if (!each.what)
      each.run();
    else if (each.answer_to != 0)
      answer(each);
    else
      dispatch(*each.what);
  }

  void send_durable(const gated& each) {
    auto receivers = this->send_as_effect(each.id, [&] {
      if (each.answer_to != 0)
        answer(each);
      else
        dispatch(*each.what);
    });
    if (receivers.empty())
      released_.push_back(each.id);
    else
      sent_.emplace(each.id, std::move(receivers));
  }

  void answer(const gated& each) {
    std::visit([&]<class E>(const E& value) { this->answer_later(each.answer_to, value); }, *each.what);
  }

  void effect_taken_by(std::uint32_t receiver, effect_id id) final {
    const auto found = sent_.find(id);
    if (found == sent_.end() || std::erase(found->second, receiver) == 0 || !found->second.empty())
      return;
    sent_.erase(found);
    mark_released({id});
  }

  void mark_released(std::vector<effect_id> ids) {
    journal_write write;
    write.actor = this->actor_name();
    write.incarnation = this->incarnation_number();
    write.released = std::move(ids);
    (void)this->outside().durable->submit(std::move(write));
  }

  void forget_what_is_gated() final {
    gate_.clear();
    opened_ = 0;
  }

  [[nodiscard]] std::int64_t submitted_upto() const final { return submitted_upto_; }

  [[nodiscard]] std::vector<std::uint64_t> durable_answers() const final {
    std::vector<std::uint64_t> result;
    for (const auto& each : gate_)
      if (each.answer_to != 0 && each.id.event != 0)
        result.push_back(each.answer_to);
    return result;
  }

  state state_{};
  std::deque<gated> gate_;                               // not gone out yet, oldest first
  std::size_t opened_ = 0;                               // of it, by the handler under way
  std::vector<effect_id> released_;                      // likewise
  std::map<effect_id, std::vector<std::uint32_t>> sent_; // gone out, and by whom not confirmed yet
  journal_write pending_;                                // of this handler, or refused by the journal
  bool is_refused_ = false;
  std::int64_t last_event_ = 0;
  std::int64_t noted_upto_ = 0; // the newest event of the handlers that have ended
  std::int64_t submitted_upto_ = 0;
  std::int64_t written_upto_ = 0;
  int events_since_snapshot_ = 0;
  std::size_t bytes_since_snapshot_ = 0;
};

} // namespace godwit::runtime
