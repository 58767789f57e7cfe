// The actors of the runtime drill. Each message goes source -> relay -> ledger -> auditor; every tenth through the
// journal.
#pragma once

#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "programs/godwit-drill/audit.hpp"
#include "programs/godwit-drill/drill_messages.hpp"
#include "runtime/actor_base.hpp"
#include "runtime/define_message.hpp"
#include "runtime/durable_actor.hpp"

namespace godwit::drill {

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
