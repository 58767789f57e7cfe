// A small world of three actors for tests of the runtime: a relay without memory, a ledger with durable state, an
// auditor that notes what came out. What the auditor saw and what was answered is kept outside the actors, where no
// crash reaches it.
//
//   test ──deposit──> relay ──deposit──> ledger ──receipt──> auditor
//   test ──get_balance──────────────────> ledger (answered from memory)
//   test ──withdraw─────────────────────> ledger (answered when durable)
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <variant>
#include <vector>

#include "runtime/actor_base.hpp"
#include "runtime/define_message.hpp"
#include "runtime/durable_actor.hpp"

namespace godwit::tests {

struct deposit {
  std::int64_t key = 0; // made by the sender, unique
  std::int64_t amount = 0;
  static constexpr auto fields =
      io::table("test.deposit", io::field("key", &deposit::key), io::field("amount", &deposit::amount));
};

struct withdraw {
  std::int64_t key = 0;
  std::int64_t amount = 0;
  static constexpr auto fields =
      io::table("test.withdraw", io::field("key", &withdraw::key), io::field("amount", &withdraw::amount));
};

struct withdrawn {
  std::int64_t key = 0;
  bool granted = false;
  static constexpr auto fields =
      io::table("test.withdrawn", io::field("key", &withdrawn::key), io::field("granted", &withdrawn::granted));
};

struct get_balance {
  static constexpr auto fields = io::table("test.get_balance");
};

struct balance {
  std::int64_t amount = 0;
  std::int64_t deposits = 0;
  std::string ballast;
  static constexpr auto fields =
      io::table("test.balance", io::field("amount", &balance::amount), io::field("deposits", &balance::deposits),
                io::field("ballast", &balance::ballast));
};

struct receipt {
  std::int64_t key = 0;
  std::int64_t balance_after = 0;
  static constexpr auto fields =
      io::table("test.receipt", io::field("key", &receipt::key), io::field("balance_after", &receipt::balance_after));
};

// Goes out without waiting for the disk, as a failsafe command does.
struct alarm {
  std::int64_t key = 0;
  static constexpr auto goes_out = runtime::effect_kind::at_once;
  static constexpr auto fields = io::table("test.alarm", io::field("key", &alarm::key));
};

using auditor_handle = runtime::mailbox<runtime::tells<receipt>, runtime::tells<alarm>>;
using ledger_handle =
    runtime::mailbox<runtime::tells<deposit>, runtime::asks<withdraw, withdrawn>, runtime::asks<get_balance, balance>>;
using relay_handle = runtime::mailbox<runtime::tells<deposit>>;

struct ledger_core {
  struct state {
    std::int64_t amount = 0;
    std::int64_t deposits = 0;
    std::string ballast; // to give the snapshot a size
    static constexpr int version = 1;
    static constexpr auto fields =
        io::table("test.ledger_state", io::field("amount", &state::amount), io::field("deposits", &state::deposits),
                  io::field("ballast", &state::ballast));
  };
  using event = std::variant<deposit, withdraw>;
  using effect = std::variant<receipt, withdrawn, alarm>;

  static constexpr std::int64_t alarm_above = 900; // a deposit larger than this is reported at once

  static std::vector<effect> apply(state& s, const event& happened, std::int64_t) {
    if (const auto* d = std::get_if<deposit>(&happened)) {
      s.amount += d->amount;
      ++s.deposits;
      std::vector<effect> result{receipt{d->key, s.amount}};
      if (d->amount > alarm_above)
        result.emplace_back(alarm{d->key});
      return result;
    }
    const auto& w = std::get<withdraw>(happened);
    const bool granted = s.amount >= w.amount;
    if (granted)
      s.amount -= w.amount;
    return {withdrawn{w.key, granted}};
  }

  static std::vector<effect> resume(const state&, std::int64_t) { return {}; }
};

class ledger_actor final : public runtime::durable_actor<ledger_handle, ledger_core> {
public:
  ledger_actor(runtime::spawn_context context, auditor_handle auditor)
      : durable_actor(std::move(context)), auditor_(std::move(auditor)) {}

protected:
  behavior_type handlers() override {
    return {on_event<deposit>(), on_request<withdraw, withdrawn>(), on<get_balance>([this](const get_balance&) {
              return balance{current_state().amount, current_state().deposits, current_state().ballast};
            })};
  }

  void dispatch(const effect& each) override {
    if (const auto* r = std::get_if<receipt>(&each))
      tell(auditor_, *r);
    else if (const auto* a = std::get_if<alarm>(&each))
      tell(auditor_, *a);
  }

private:
  auditor_handle auditor_;
};

// What came out, kept outside the actors.
struct audit {
  std::map<std::int64_t, int> receipts; // by key: how often
  std::map<std::int64_t, int> alarms;
};

class auditor_actor final : public runtime::actor_base<auditor_handle> {
public:
  auditor_actor(runtime::spawn_context context, audit* seen) : actor_base(std::move(context)), seen_(seen) {}

protected:
  behavior_type handlers() override {
    return {on<receipt>([this](const receipt& r) { ++seen_->receipts[r.key]; }),
            on<alarm>([this](const alarm& a) { ++seen_->alarms[a.key]; })};
  }

private:
  audit* seen_;
};

class relay_actor final : public runtime::actor_base<relay_handle> {
public:
  relay_actor(runtime::spawn_context context, ledger_handle next)
      : actor_base(std::move(context)), next_(std::move(next)) {}

protected:
  behavior_type handlers() override {
    return {on<deposit>([this](const deposit& d) { tell(next_, d); })};
  }

private:
  ledger_handle next_;
};

} // namespace godwit::tests
