#include <gtest/gtest.h>

#include "runtime/define_message.hpp"
#include "runtime/simulation/simulation.hpp"
#include "tests/support/ledger.hpp"

namespace durable_actor_test {

using namespace godwit;
using namespace godwit::runtime;
using namespace godwit::tests;
using namespace std::chrono_literals;

child_policy patient() {
  child_policy result;
  result.restart.intensity = 1000;
  return result;
}

// One process over a disk that may outlive it.
struct process {
  explicit process(simulated_disk& disk, audit& seen) : world(disk, 1) {
    const auto auditor = world.actors().add<auditor_actor>({.name = "auditor"}, patient(), &seen);
    ledger = world.actors().add<ledger_actor>({.name = "ledger"}, patient(), auditor);
    front = world.actors().add<relay_actor>({.name = "relay"}, patient(), ledger);
    world.start();
    world.run_until_idle();
  }
  std::int64_t balance_now() {
    const auto asked = world.ask(ledger, 1s, get_balance{});
    world.run_until_idle();
    return asked->answer.amount;
  }
  simulation world;
  ledger_handle ledger;
  relay_handle front;
};

TEST(durable_actor, an_effect_waits_until_its_event_is_on_the_disk) {
  simulated_disk disk;
  audit seen;
  process p(disk, seen);
  p.world.journal().fail_writes(true);
  p.world.tell(p.ledger, deposit{1, 10});
  p.world.run_until_idle();
  EXPECT_EQ(p.balance_now(), 10) << "decided in memory";
  EXPECT_TRUE(seen.receipts.empty()) << "let out before it was durable";
  p.world.journal().fail_writes(false);
  p.world.run_until_idle();
  EXPECT_EQ(seen.receipts[1], 1);
}

TEST(durable_actor, an_immediate_effect_does_not_wait_for_the_disk) {
  simulated_disk disk;
  audit seen;
  process p(disk, seen);
  p.world.journal().fail_writes(true);
  p.world.tell(p.ledger, deposit{1, 1000});
  p.world.run_until_idle();
  EXPECT_EQ(seen.alarms[1], 1);
  EXPECT_TRUE(seen.receipts.empty());
}

TEST(durable_actor, a_crash_at_any_point_neither_loses_nor_doubles) {
  for (const auto point : {crash_point::before_handler, crash_point::after_handler, crash_point::after_commit,
                           crash_point::before_dispatch}) {
    simulated_disk disk;
    audit seen;
    process p(disk, seen);
    p.world.crash_at("ledger", point);
    p.world.tell(p.front, deposit{1, 10});
    p.world.tell(p.front, deposit{2, 5});
    p.world.advance(1s);
    EXPECT_EQ(p.balance_now(), 15) << static_cast<int>(point);
    EXPECT_EQ(seen.receipts[1], 1) << static_cast<int>(point);
    EXPECT_EQ(seen.receipts[2], 1) << static_cast<int>(point);
    EXPECT_EQ(p.world.counters("ledger").crashes, 1U) << static_cast<int>(point);
  }
}

TEST(durable_actor, a_receiver_drops_an_effect_that_it_has_seen) {
  simulated_disk disk;
  audit seen;
  process p(disk, seen);
  p.world.tell(p.ledger, deposit{1, 10});
  p.world.run_until_idle();
  const auto released = disk.actors["ledger"].kept.effects;
  EXPECT_TRUE(released.empty()) << "marked released";
  // As if the ledger had died after sending, before the mark reached the disk.
  disk.actors["ledger"].kept.effects.push_back({{1, 0}, "test.receipt", R"({"key":1,"balance_after":10})", 0});
  p.world.kill("ledger");
  p.world.advance(1s);
  EXPECT_EQ(seen.receipts[1], 1);
  EXPECT_EQ(p.world.counters("auditor").repeated, 1U);
}

TEST(durable_actor, state_and_unreleased_effects_survive_the_process) {
  simulated_disk disk;
  audit seen;
  {
    process p(disk, seen);
    for (std::int64_t i = 1; i <= 250; ++i)
      p.world.tell(p.ledger, deposit{i, 1});
    p.world.run_until_idle();
    p.world.crash_at("ledger", crash_point::before_dispatch);
    p.world.tell(p.ledger, deposit{251, 1});
    for (int i = 0; i < 4; ++i)
      p.world.step(0);
  } // killed
  process again(disk, seen);
  again.world.advance(1s);
  EXPECT_EQ(again.balance_now(), static_cast<std::int64_t>(disk.actors["ledger"].kept.last_event));
  EXPECT_GE(again.balance_now(), 250);
  for (std::int64_t i = 1; i <= again.balance_now(); ++i)
    EXPECT_GE(seen.receipts[i], 1) << i;
  ASSERT_TRUE(disk.actors["ledger"].kept.snapshot);
  EXPECT_LE(disk.actors["ledger"].kept.events.size(), 100U);
}

TEST(durable_actor, a_durable_answer_survives_a_crash_of_the_answering_actor) {
  for (const auto point : {crash_point::before_handler, crash_point::after_handler, crash_point::after_commit,
                           crash_point::before_dispatch}) {
    simulated_disk disk;
    audit seen;
    process p(disk, seen);
    p.world.tell(p.ledger, deposit{1, 10});
    p.world.run_until_idle();
    p.world.crash_at("ledger", point);
    const auto asked = p.world.ask(p.ledger, 10s, withdraw{2, 4});
    p.world.advance(2s);
    EXPECT_EQ(asked->answers, 1) << static_cast<int>(point);
    EXPECT_TRUE(asked->answer.granted);
    EXPECT_EQ(p.balance_now(), 6) << static_cast<int>(point);
  }
}

TEST(durable_actor, it_restarts_with_its_state_while_the_disk_refuses_to_write) {
  simulated_disk disk;
  audit seen;
  process p(disk, seen);
  p.world.tell(p.ledger, deposit{1, 10});
  p.world.run_until_idle();
  p.world.journal().fail_writes(true);
  p.world.tell(p.ledger, deposit{2, 5});
  p.world.run_until_idle();
  p.world.kill("ledger");
  p.world.advance(1s);
  EXPECT_EQ(p.balance_now(), 15);
  EXPECT_EQ(seen.receipts.count(2), 0U);
  p.world.journal().fail_writes(false);
  p.world.run_until_idle();
  EXPECT_EQ(seen.receipts[2], 1);
}

TEST(durable_actor, state_of_a_newer_version_is_refused_at_once_and_named) {
  simulated_disk disk;
  disk.actors["ledger"].kept.snapshot = snapshot_record{7, 0, 99, "{}"};
  audit seen;
  process p(disk, seen);
  p.world.advance(1s);
  EXPECT_EQ(p.world.counters("ledger").crashes, 1U) << "not tried again";
  bool named = false;
  for (const auto& each : p.world.health().entries())
    named = named || (each.colour == health_colour::red && each.reason.find("version 99") != std::string::npos);
  EXPECT_TRUE(named);
}

struct core_v2 {
  struct state {
    std::int64_t total = 0;
    static constexpr int version = 2;
    static constexpr auto fields = io::table("test.state_v2", io::field("total", &state::total));
  };
  static tl::expected<nlohmann::json, std::string> migrate(nlohmann::json old, int from_version) {
    if (from_version != 1)
      return tl::unexpected(std::string("unknown version"));
    return nlohmann::json{{"total", old.at("amount")}};
  }
};

TEST(durable_actor, an_older_snapshot_is_migrated) {
  const auto state = read_state<core_v2>("x", {5, 0, 1, R"({"amount":42})"});
  EXPECT_EQ(state.total, 42);
}

} // namespace durable_actor_test
