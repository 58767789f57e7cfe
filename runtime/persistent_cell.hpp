// An actor whose decisions survive: a pure core, and around it the order "decide, commit, let out, mark released".
//
//   struct core {
//     using state = ...;                                    // a field table and `static constexpr int version`
//     using event = std::variant<moved, reset>;             // messages with field tables
//     using effect = std::variant<milestone, total>;
//     static std::vector<effect> handle(state&, const event&, std::int64_t now_ns); // decides; no clock, no I/O, no
//     CAF static std::vector<effect> resume(const state&, std::int64_t now_ns);         // what a new incarnation has
//     to start again static tl::expected<nlohmann::json, std::string> migrate(nlohmann::json state, int from_version);
//     // only if version > 1
//   };
//
// on_event<E>() is a handler that gives a tell to the core; on_request<Q, R>() one for an ask, answered by the core's
// effect R. The event is written together with its effects; each goes out through let_out() once it is on the disk, and
// is marked released when the actor that it was told to has it. After a crash the state is the newest snapshot with the
// later events handled again, and every effect not marked released goes out again with the same id: receivers drop what
// they have seen. `now_ns` is wall time and part of the event, so that handling it again decides the same.
//
// An effect type with `static constexpr bool immediate = true` (a failsafe command) does not wait for the disk: it goes
// out in the same turn, before the event is handed to the journal. One effect is at most one message to each receiver.
// stage() lets a shell turn an effect into rows of its own tables or of the outbox, in the same transaction. Thread: as
// cell.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "runtime/assert.hpp"
#include "runtime/cell.hpp"
#include "runtime/internal_messages.hpp"
#include "runtime/stored_state.hpp"
#include "runtime/variant_json.hpp"

namespace godwit::runtime {

// A state is written in full after this many events, so that a recovery reads one snapshot and at most as many events.
inline constexpr int events_per_snapshot = 100;

// Effects of one actor that wait for the disk or for a receiver. At the bound it takes no more events (backlog_full).
inline constexpr std::size_t max_unreleased_effects = 10'000;

template <class E>
inline constexpr bool is_immediate = requires {
  requires E::immediate;
};

template <class Mailbox, class Core>
class persistent_cell : public cell<Mailbox> {
public:
  using effect = typename Core::effect;
  using event = typename Core::event;
  using state = typename Core::state;
  static constexpr bool is_persistent = true;

  persistent_cell(caf::actor_config& config, birth born) : cell<Mailbox>(config, std::move(born)) {}

protected:
  // Sends what the effect means. Called in order, once it is durable; what is told meanwhile carries the effect's id.
  virtual void let_out(const effect& each) = 0;
  // Adds rows of the actor's own tables, or of the outbox, to the transaction of the event.
  virtual void add_rows(const event& happened, journal_write& write) {
    (void)happened;
    (void)write;
  }
  // True when the effect is nothing but what it adds to the transaction; then it is not kept and not let out.
  virtual bool stage(const effect& each, journal_write& write) {
    (void)each;
    (void)write;
    return false;
  }

  [[nodiscard]] const state& current_state() const { return state_; }

  // Gives an event to the core from a handler that does more than that. At most once in a handler, and last in it.
  void commit(event happened) { commit(std::move(happened), {}); }

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

  typename cell<Mailbox>::behavior_type make_behavior() final {
    restore();
    auto result = cell<Mailbox>::make_behavior();
    for (const auto& each : Core::resume(state_, this->wall_ns()))
      let_out(each);
    this->send_held();
    durable_upto(this->birth_.restored.durable_upto);
    this->birth_.restored = {};
    return result;
  }

private:
  struct gated_effect {
    effect_id id;
    effect what;
    std::uint64_t answer_to = 0; // id of the request, 0 = not an answer
  };

  struct awaited_answer {
    std::uint64_t request_id = 0;
    std::size_t alternative = 0; // which alternative of effect is the answer
  };

  void restore() {
    auto& from = this->birth_.restored;
    if (from.snapshot)
      state_ = read_state<Core>(this->actor_name(), *from.snapshot);
    for (const auto& each : from.events) {
      (void)Core::handle(state_, read_alternative<event>(this->actor_name(), each.type, each.body), each.at_ns);
      ++events_since_snapshot_;
    }
    last_event_ = from.last_event;
    for (const auto& each : from.effects)
      gate_.push_back({each.id, read_alternative<effect>(this->actor_name(), each.type, each.body), each.answer_to});
    for (const auto& each : from.seen)
      if (const auto source = this->outside().names->number(each.source))
        this->address().mark_seen(*source, each.upto);
  }

  // Decide, let out what must not wait, hand the rest to the journal. Throws when the journal refuses: the state in
  // memory is then ahead of the disk and has to go with the incarnation.
  void commit(event happened, awaited_answer awaited) {
    if (gate_.size() + sent_.size() >= max_unreleased_effects)
      throw backlog_full(this->actor_name());
    const auto at_ns = this->wall_ns();
    auto effects = Core::handle(state_, happened, at_ns);
    const auto number = last_event_ + 1;
    auto write = write_for(number, at_ns, happened);
    add_rows(happened, write);
    std::vector<gated_effect> gated;
    bool answered = awaited.request_id == 0;
    for (std::uint32_t n = 0; n < effects.size(); ++n) {
      const bool is_answer = awaited.request_id != 0 && effects[n].index() == awaited.alternative;
      answered = answered || is_answer;
      gated_effect each{{number, n}, std::move(effects[n]), is_answer ? awaited.request_id : 0};
      if (std::visit([]<class E>(const E&) { return is_immediate<E>; }, each.what))
        this->send_at_once([&] { let_out(each.what); });
      else if (!stage(each.what, write))
        gated.push_back(std::move(each));
    }
    GODWIT_ASSERT(answered, "a core answers each request with exactly one effect of the answer's type");
    for (const auto& each : gated)
      write.effects.push_back({each.id, alternative_name(each.what), alternative_json(each.what), each.answer_to});
    submit_or_throw(std::move(write));
    this->mark_committed();
    last_event_ = number;
    for (auto& each : gated)
      gate_.push_back(std::move(each));
    this->hit(crash_point::after_commit);
  }

  journal_write write_for(std::int64_t number, std::int64_t at_ns, const event& happened) {
    auto write = empty_write();
    write.event = {number, at_ns, alternative_name(happened), alternative_json(happened)};
    const auto& head = this->current();
    if (head.effect_event != 0)
      write.seen.push_back({this->outside().names->name(head.sender), {head.effect_event, head.effect_n}});
    if (++events_since_snapshot_ >= events_per_snapshot) {
      write.snapshot = {number, at_ns, state::version, io::to_json(state_)};
      events_since_snapshot_ = 0;
    }
    write.done = [address = this->birth_.address, number](const commit_result& result) {
      auto news = result ? caf::make_mailbox_element(nullptr, caf::make_message_id(), {}, mail<durable>{{}, {number}})
                         : caf::make_mailbox_element(nullptr, caf::make_message_id(), {},
                                                     mail<write_failed>{{}, {result.error().message()}});
      address->enqueue(std::move(news), nullptr);
    };
    return write;
  }

  void submit_or_throw(journal_write write) {
    if (auto taken = this->outside().durable->submit(std::move(write)); !taken)
      throw journal_refused(taken.error());
  }

  // Lets out what is on the disk by now. What is told to an actor is marked released when that actor has confirmed it,
  // the rest at once. A mark that the journal refuses only means that the effect goes out once more after a crash, and
  // is dropped as seen.
  void durable_upto(std::int64_t upto) override {
    if (gate_.empty() || gate_.front().id.event > upto)
      return;
    auto write = empty_write();
    std::vector<std::pair<effect_id, std::vector<std::uint32_t>>> sent;
    const mail<durable> m{{this->address().next_id(), 0, 0, 0, this->address().number()}, {upto}};
    this->run_internal(m, [&] {
      for (const auto& each : gate_) {
        if (each.id.event > upto)
          break;
        this->hit(crash_point::before_let_out);
        sent.emplace_back(each.id, send_effect(each));
      }
    });
    gate_.erase(gate_.begin(), gate_.begin() + static_cast<std::ptrdiff_t>(sent.size()));
    for (auto& [id, receivers] : sent) {
      if (receivers.empty())
        write.released.push_back(id);
      else
        sent_.emplace(id, std::move(receivers));
    }
    if (!write.released.empty())
      (void)this->outside().durable->submit(std::move(write));
  }

  void effect_taken_by(std::uint32_t receiver, effect_id id) override {
    const auto found = sent_.find(id);
    if (found == sent_.end() || std::erase(found->second, receiver) == 0 || !found->second.empty())
      return;
    sent_.erase(found);
    auto write = empty_write();
    write.released.push_back(id);
    (void)this->outside().durable->submit(std::move(write));
  }

  void forget_what_is_gated() override { gate_.clear(); }

  [[nodiscard]] journal_write empty_write() const {
    journal_write write;
    write.actor = this->actor_name();
    write.incarnation = this->incarnation();
    return write;
  }

  [[nodiscard]] std::vector<std::uint64_t> durable_answers() const override {
    std::vector<std::uint64_t> result;
    for (const auto& each : gate_)
      if (each.answer_to != 0)
        result.push_back(each.answer_to);
    return result;
  }

  // Returns the numbers of the actors that have to confirm it.
  std::vector<std::uint32_t> send_effect(const gated_effect& each) {
    this->sending_effect_ = each.id;
    this->effect_receivers_.clear();
    if (each.answer_to != 0)
      std::visit([&]<class E>(const E& value) { this->answer_later(each.answer_to, value); }, each.what);
    else
      let_out(each.what);
    this->sending_effect_ = {};
    return std::exchange(this->effect_receivers_, {});
  }

  state state_{};
  std::deque<gated_effect> gate_;                        // not let out yet, oldest first
  std::map<effect_id, std::vector<std::uint32_t>> sent_; // let out, and by whom not confirmed yet
  std::int64_t last_event_ = 0;
  int events_since_snapshot_ = 0;
};

} // namespace godwit::runtime
