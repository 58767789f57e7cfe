// Any interleaving of messages, time, crashes, kills and a failing disk, over the whole actor system in virtual time.
//
// RC_PARAMS sets the number of cases and the seed; a failure prints the shrunk sequence and the text to run it again.
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <array>
#include <memory>
#include <optional>
#include <ostream>
#include <set>

#include "runtime/simulation/simulation.hpp"
#include "tests/support/ledger.hpp"
#include "tests/support/recorded_promises.hpp"

namespace godwit::tests {

enum class op_kind : std::uint8_t {
  deposit,
  withdraw,
  step,
  advance,
  kill,
  crash,
  disk_fails,
  disk_heals,
  journal_full,
  journal_has_room,
  write_broken,
  process_killed
};

struct op {
  op_kind kind = op_kind::step;
  std::uint32_t arg = 0;
};

std::ostream& operator<<(std::ostream& out, const op& each) {
  constexpr std::array names{"deposit",      "withdraw",      "step",       "advance",      "kill",
                             "crash",        "disk_fails",    "disk_heals", "journal_full", "journal_has_room",
                             "write_broken", "process_killed"};
  return out << names.at(static_cast<std::size_t>(each.kind)) << '(' << each.arg << ')';
}

} // namespace godwit::tests

namespace rc {

template <>
struct Arbitrary<godwit::tests::op> {
  static Gen<godwit::tests::op> arbitrary() {
    using godwit::tests::op_kind;
    return gen::build<godwit::tests::op>(
        gen::set(&godwit::tests::op::kind, gen::weightedElement<op_kind>({{20, op_kind::deposit},
                                                                          {6, op_kind::withdraw},
                                                                          {40, op_kind::step},
                                                                          {6, op_kind::advance},
                                                                          {6, op_kind::kill},
                                                                          {10, op_kind::crash},
                                                                          {2, op_kind::disk_fails},
                                                                          {4, op_kind::disk_heals},
                                                                          {2, op_kind::journal_full},
                                                                          {4, op_kind::journal_has_room},
                                                                          {1, op_kind::write_broken},
                                                                          {1, op_kind::process_killed}})),
        gen::set(&godwit::tests::op::arg, gen::inRange<std::uint32_t>(0, 1000)));
  }
};

} // namespace rc

namespace runtime_property_test {

using namespace godwit;
using namespace godwit::runtime;
using namespace godwit::tests;
using namespace std::chrono_literals;

constexpr std::array actor_names{"relay", "ledger", "auditor"};
constexpr std::array points{crash_point::before_handler, crash_point::after_handler, crash_point::after_commit,
                            crash_point::before_dispatch};

child_policy patient() {
  child_policy result;
  result.restart = {.intensity = 100'000, .period = 60s, .backoff_initial = 10ms, .backoff_max = 100ms};
  return result;
}

struct process {
  process(simulated_disk& disk, audit& seen, std::uint64_t seed, bool is_traced) : world(disk, seed, {}, is_traced) {
    auditor = world.actors().add<auditor_actor>({.name = "auditor"}, patient(), &seen);
    ledger = world.actors().add<ledger_actor>({.name = "ledger"}, patient(), auditor);
    relay = world.actors().add<relay_actor>({.name = "relay"}, patient(), ledger);
    world.start();
  }
  simulation world;
  auditor_handle auditor;
  ledger_handle ledger;
  relay_handle relay;
};

// What the test did and was told, to hold against what the disk and the auditor say.
struct history {
  std::map<std::int64_t, std::int64_t> deposits; // key -> amount
  std::vector<std::pair<std::int64_t, std::shared_ptr<asked<withdrawn>>>> withdrawals;
};

class run {
public:
  // Recording takes as long as all the rest: only each so manieth run does.
  static constexpr std::uint64_t recorded_each = 8;

  explicit run(std::uint64_t seed) : seed_(seed) { start(); }

  void apply(const op& each) {
    auto& world = process_->world;
    switch (each.kind) {
    case op_kind::deposit: {
      const deposit d{++key_, each.arg + 1};
      history_.deposits[d.key] = d.amount;
      if (each.arg % 3 == 0)
        world.tell(process_->ledger, d);
      else
        world.tell(process_->relay, d);
      break;
    }
    case op_kind::withdraw:
      history_.withdrawals.emplace_back(each.arg, world.ask(process_->ledger, 30s, withdraw{++key_, each.arg}));
      break;
    case op_kind::step:
      world.step(each.arg);
      break;
    case op_kind::advance:
      world.advance(std::chrono::milliseconds(each.arg % 50));
      break;
    case op_kind::kill:
      world.kill(actor_names.at(each.arg % actor_names.size()));
      break;
    case op_kind::crash:
      plan_crash(each.arg);
      break;
    case op_kind::disk_fails:
      world.journal().fail_writes(true);
      break;
    case op_kind::disk_heals:
      world.journal().fail_writes(false);
      break;
    case op_kind::journal_full:
      world.journal().refuse_writes(true);
      break;
    case op_kind::journal_has_room:
      world.journal().refuse_writes(false);
      break;
    case op_kind::write_broken:
      world.journal().break_writes_of("ledger", 1);
      break;
    case op_kind::process_killed:
      promises_.take(process_->world.trace().lines());
      process_.reset();
      ++process_kills_;
      start();
      break;
    }
  }

  // Everything heals; what is owed is paid.
  void finish() {
    process_->world.forget_planned_crashes();
    process_->world.journal().fail_writes(false);
    process_->world.journal().refuse_writes(false);
    process_->world.advance(3s);
    const auto asked_balance = process_->world.ask(process_->ledger, 10s, get_balance{});
    process_->world.advance(1s);
    RC_ASSERT(asked_balance->answers == 1);
    final_ = asked_balance->answer;
    promises_.take(process_->world.trace().lines());
  }

  void check() const {
    RC_ASSERT(promises_.broken() == std::string());
    auto accounted = dead_keys("test.receipt"); // crashed the auditor too often: given up, but on record
    for (const auto& [key, times] : seen_.receipts) {
      RC_ASSERT(times == 1 || process_kills_ > 0); // the auditor itself keeps no memory over a killed process
      accounted.insert(key);
    }
    std::int64_t deposited = 0;
    for (const auto key : accounted)
      deposited += history_.deposits.at(key);
    RC_ASSERT(static_cast<std::int64_t>(accounted.size()) == final_.deposits); // none lost, none doubled
    if (process_kills_ == 0)
      RC_ASSERT(accounted.size() + dead_keys("test.deposit").size() == history_.deposits.size());
    std::int64_t granted = 0;
    std::int64_t unknown = 0;
    for (const auto& [amount, asked] : history_.withdrawals) {
      RC_ASSERT(asked->answers + asked->failures <= 1);
      if (process_kills_ == 0)
        RC_ASSERT(asked->answers + asked->failures == 1);
      if (asked->answers == 1)
        granted += asked->answer.granted ? amount : 0;
      else
        unknown += amount;
    }
    RC_ASSERT(final_.amount <= deposited - granted);
    RC_ASSERT(final_.amount >= deposited - granted - unknown);
  }

private:
  void start() {
    process_ = std::make_unique<process>(disk_, seen_, seed_, seed_ % recorded_each == 0);
    process_->world.step(0);
  }

  // The auditor writes into the test's own memory, which no crash takes back: it crashes before that or not at all.
  void plan_crash(std::uint32_t arg) {
    const std::string actor = actor_names.at(arg % actor_names.size());
    process_->world.crash_at(actor,
                             actor == "auditor" ? crash_point::before_handler : points.at((arg / 3) % points.size()));
  }

  [[nodiscard]] std::set<std::int64_t> dead_keys(const std::string& type) const {
    std::set<std::int64_t> result;
    for (const auto& each : disk_.dead_letters)
      if (each.type == type)
        result.insert(nlohmann::json::parse(each.body).at("key").get<std::int64_t>());
    return result;
  }

  std::uint64_t seed_;
  simulated_disk disk_;
  audit seen_;
  history history_;
  balance final_;
  std::int64_t key_ = 0;
  int process_kills_ = 0;
  std::unique_ptr<process> process_;
  recorded_promises promises_;
};

RC_GTEST_PROP(runtime_property, nothing_acknowledged_is_lost_and_no_effect_is_doubled, ()) {
  const auto ops = *rc::gen::arbitrary<std::vector<op>>();
  run r(ops.size());
  for (const auto& each : ops)
    r.apply(each);
  r.finish();
  r.check();
}

RC_GTEST_PROP(runtime_property, the_same_seed_and_steps_give_the_same_trace, ()) {
  const auto ops = *rc::gen::arbitrary<std::vector<op>>();
  const auto trace_of = [&] {
    simulated_disk disk;
    audit seen;
    simulation world(disk, 7);
    const auto auditor = world.actors().add<auditor_actor>({.name = "auditor"}, patient(), &seen);
    const auto ledger = world.actors().add<ledger_actor>({.name = "ledger"}, patient(), auditor);
    world.start();
    std::int64_t key = 0;
    for (const auto& each : ops) {
      if (each.kind == op_kind::deposit)
        world.tell(ledger, deposit{++key, each.arg});
      else if (each.kind == op_kind::crash)
        world.crash_at("ledger", points.at(each.arg % points.size()));
      else if (each.kind == op_kind::advance)
        world.advance(1ms);
      else
        world.step(each.arg);
    }
    return world.trace().lines();
  };
  RC_ASSERT(trace_of() == trace_of());
}

} // namespace runtime_property_test
