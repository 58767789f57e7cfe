// The actors of actor_victim. What leaves the auditor is on a pipe, where no kill takes it back.
//
//   main thread ──deposit──> relay_N ──deposit──> ledger_N ──receipt (when durable)──> auditor ──"KEY\n"──> stdout
//                                                  │ same transaction: event and row
//                                                  └──> deposit_row(key)
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "io/fields/field_table.hpp"
#include "runtime/actor_base.hpp"
#include "runtime/define_message.hpp"
#include "runtime/durable_actor.hpp"

namespace godwit::tests::drill {

inline constexpr std::uint32_t lanes = 4; // relays, and ledgers

// No unique index: a row that was written twice is to be seen, not refused.
inline constexpr const char* deposit_table = "CREATE TABLE deposit_row(key INTEGER NOT NULL)";

inline std::string ledger_name(std::uint32_t lane) { return "ledger_" + std::to_string(lane); }

struct deposit {
  std::int64_t key = 0; // unique over all lives of the process
  static constexpr auto fields = io::table("drill.deposit", io::field("key", &deposit::key));
};

// The deposit is on the disk.
struct receipt {
  std::int64_t key = 0;
  static constexpr auto fields = io::table("drill.receipt", io::field("key", &receipt::key));
};

using depositor_handle = runtime::mailbox<runtime::tells<deposit>>;
using auditor_handle = runtime::mailbox<runtime::tells<receipt>>;

struct ledger_core {
  struct state {
    std::int64_t deposits = 0;
    static constexpr int version = 1;
    static constexpr auto fields = io::table("drill.ledger_state", io::field("deposits", &state::deposits));
  };
  using event = std::variant<deposit>;
  using effect = std::variant<receipt>;

  static std::vector<effect> apply(state& s, const event& happened, std::int64_t) {
    ++s.deposits;
    return {receipt{std::get<deposit>(happened).key}};
  }
  static std::vector<effect> resume(const state&, std::int64_t) { return {}; }
};

class relay final : public runtime::actor_base<depositor_handle> {
public:
  relay(runtime::spawn_context context, depositor_handle next)
      : actor_base(std::move(context)), next_(std::move(next)) {}

protected:
  behavior_type handlers() override {
    return {on<deposit>([this](const deposit& d) { tell(next_, d); })};
  }

private:
  depositor_handle next_;
};

class ledger final : public runtime::durable_actor<depositor_handle, ledger_core> {
public:
  ledger(runtime::spawn_context context, auditor_handle auditor)
      : durable_actor(std::move(context)), auditor_(std::move(auditor)) {}

protected:
  behavior_type handlers() override { return {on_event<deposit>()}; }

  void add_rows(const event& happened, runtime::journal_write& write) override {
    write.rows.push_back({"INSERT INTO deposit_row(key) VALUES (?)", {std::get<deposit>(happened).key}});
  }

  void dispatch(const effect& each) override { tell(auditor_, std::get<receipt>(each)); }

private:
  auditor_handle auditor_;
};

class auditor final : public runtime::actor_base<auditor_handle> {
public:
  // NEW_HANDLED counts the receipts of this life's keys, those above LAST_OLD_KEY.
  auditor(runtime::spawn_context context, std::int64_t last_old_key, std::atomic<std::int64_t>* new_handled)
      : actor_base(std::move(context)), last_old_key_(last_old_key), new_handled_(new_handled) {}

protected:
  behavior_type handlers() override {
    return {on<receipt>([this](const receipt& r) {
      acknowledge(r.key);
      if (r.key > last_old_key_)
        new_handled_->fetch_add(1);
    })};
  }

private:
  static void acknowledge(std::int64_t key);

  std::int64_t last_old_key_;
  std::atomic<std::int64_t>* new_handled_;
};

} // namespace godwit::tests::drill
