// The actors of the runtime drill. Each message goes source -> relay -> ledger -> auditor; every tenth through the
// journal.
#pragma once

#include <atomic>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "io/fields/field_table.hpp"
#include "runtime/actor_base.hpp"
#include "runtime/define_message.hpp"
#include "runtime/durable_actor.hpp"
#include "runtime/seam.hpp"

namespace godwit::drill {

// What the actors of the runtime drill say to each other.

// One of the messages that are counted, numbered from 1 over all senders.
struct work {
  std::uint32_t sender = 0;
  std::uint64_t seq = 0;
  bool poison = false; // crashes its handler each time
  GODWIT_FIELDS(work, "drill.work", sender, seq, poison);
};

// It has been handled; for one with a durable effect: and the effect is on the disk.
struct receipt {
  std::uint32_t sender = 0;
  std::uint64_t seq = 0;
  GODWIT_FIELDS(receipt, "drill.receipt", sender, seq);
};

// Every tenth message has a durable effect: a row (sender, seq) of the table drill_effect.
inline constexpr std::uint64_t durable_every = 10;

constexpr bool is_durable(std::uint64_t seq) { return seq % durable_every == 0; }

using auditor_handle = runtime::mailbox<runtime::tells<receipt>>;
using worker_handle = runtime::mailbox<runtime::tells<work>>;

// The drill's own book, outside the actors, where no crash reaches it: how often each message came to its end.
// Messages are numbered from 1. Thread: mark() by one thread at a time; done() by any; the rest when all is over.
class audit {
public:
  explicit audit(std::uint64_t messages) : times_(messages + 1) {}

  void mark(std::uint64_t seq) {
    auto& times = times_.at(seq);
    if (times == 0)
      done_.store(done_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
    if (times < UINT8_MAX)
      ++times;
  }

  [[nodiscard]] std::uint64_t done() const { return done_.load(std::memory_order_acquire); }
  [[nodiscard]] bool is_done(std::uint64_t seq) const { return times_.at(seq) > 0; }

  // Marks beyond the first of each message.
  [[nodiscard]] std::uint64_t repeated() const {
    std::uint64_t result = 0;
    for (const auto times : times_)
      result += times > 1 ? times - 1U : 0U;
    return result;
  }

private:
  std::vector<std::uint8_t> times_;
  std::atomic<std::uint64_t> done_{0};
};

class relay final : public runtime::actor_base<worker_handle> {
public:
  relay(runtime::spawn_context context, worker_handle next) : actor_base(std::move(context)), next_(std::move(next)) {}

protected:
  behavior_type handlers() override {
    return {on<work>([this](const work& w) { tell(next_, w); })};
  }

private:
  worker_handle next_;
};

struct ledger_core {
  struct state {
    std::uint64_t effects = 0;
    std::uint64_t last_seq = 0;
    static constexpr int version = 1;
    GODWIT_FIELDS(state, "drill.ledger_state", effects, last_seq);
  };
  using event = std::variant<work>;
  using effect = std::variant<receipt>;

  static std::vector<effect> apply(state& s, const event& happened, std::int64_t) {
    const auto& w = std::get<work>(happened);
    ++s.effects;
    s.last_seq = w.seq;
    return {receipt{w.sender, w.seq}};
  }
  static std::vector<effect> resume(const state&, std::int64_t) { return {}; }
};

class ledger final : public runtime::durable_actor<worker_handle, ledger_core> {
public:
  ledger(runtime::spawn_context context, auditor_handle auditor)
      : durable_actor(std::move(context)), auditor_(std::move(auditor)) {}

protected:
  behavior_type handlers() override {
    return {on<work>([this](const work& w) {
      if (w.poison)
        throw runtime::injected_crash("this message crashes every handler");
      if (drill::is_durable(w.seq))
        commit(w);
      else
        tell(auditor_, receipt{w.sender, w.seq});
    })};
  }

  // The row belongs to the same transaction as the event; the receipt is a durable effect beside it.
  void add_rows(const event& happened, runtime::journal_write& write) override {
    const auto& w = std::get<work>(happened);
    write.rows.push_back({"INSERT INTO drill_effect(sender, seq) VALUES (?, ?)",
                          {static_cast<std::int64_t>(w.sender), static_cast<std::int64_t>(w.seq)}});
  }

  void dispatch(const effect& each) override { tell(auditor_, std::get<receipt>(each)); }

private:
  auditor_handle auditor_;
};

class auditor final : public runtime::actor_base<auditor_handle> {
public:
  auditor(runtime::spawn_context context, audit* book) : actor_base(std::move(context)), book_(book) {}

protected:
  behavior_type handlers() override {
    return {on<receipt>([this](const receipt& r) { book_->mark(r.seq); })};
  }

private:
  audit* book_;
};

} // namespace godwit::drill
