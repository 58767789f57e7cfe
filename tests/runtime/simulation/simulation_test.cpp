#include "runtime/simulation/simulation.hpp"

#include <gtest/gtest.h>

#include "tests/support/ledger.hpp"

namespace simulation_test {

using namespace godwit;
using namespace godwit::runtime;
using namespace godwit::tests;
using namespace std::chrono_literals;

struct process {
  process(simulated_disk& disk, audit& seen) : world(disk, 1) {
    const auto auditor = world.actors().add<auditor_actor>({.name = "auditor"}, {}, &seen);
    ledger = world.actors().add<ledger_actor>({.name = "ledger"}, {}, auditor);
    world.start();
    world.run_until_idle();
  }
  simulation world;
  ledger_handle ledger;
};

TEST(simulation, a_journal_that_is_held_neither_commits_nor_fails) {
  simulated_disk disk;
  audit seen;
  process p(disk, seen);
  const auto before = disk.commits;
  p.world.journal().hold(true);
  p.world.tell(p.ledger, deposit{1, 10});
  p.world.run_until_idle();
  EXPECT_EQ(disk.commits, before);
  EXPECT_TRUE(seen.receipts.empty());
  EXPECT_FALSE(p.world.journal().status().failing);
  p.world.journal().hold(false);
  p.world.run_until_idle();
  EXPECT_GT(disk.commits, before);
  EXPECT_EQ(seen.receipts[1], 1);
}

TEST(simulation, an_actor_that_hangs_takes_nothing_and_is_replaced_when_its_pings_are_not_answered) {
  simulated_disk disk;
  audit seen;
  process p(disk, seen);
  p.world.hang("ledger");
  p.world.tell(p.ledger, deposit{1, 10});
  p.world.advance(1s);
  EXPECT_TRUE(seen.receipts.empty());
  p.world.advance(15s);
  p.world.tell(p.ledger, deposit{2, 5});
  p.world.advance(1s);
  EXPECT_EQ(seen.receipts.count(1), 0U) << "it lies in the mailbox of the one that hangs";
  EXPECT_EQ(seen.receipts[2], 1);
}

TEST(simulation, durable_effects_in_the_mailbox_of_an_actor_that_hangs_are_handled_by_its_successor) {
  simulated_disk disk;
  audit seen;
  process p(disk, seen);
  p.world.tell(p.ledger, deposit{1, 10});
  p.world.run_until_idle();
  ASSERT_EQ(seen.receipts[1], 1);
  p.world.hang("auditor");
  for (const std::int64_t key : {2, 3, 4})
    p.world.tell(p.ledger, deposit{key, 10});
  p.world.advance(1s);
  ASSERT_EQ(seen.receipts.size(), 1U);
  p.world.advance(15s);
  p.world.tell(p.ledger, deposit{5, 10});
  p.world.advance(1s);
  for (const std::int64_t key : {1, 2, 3, 4, 5})
    EXPECT_EQ(seen.receipts[key], 1) << key;
}

TEST(simulation, a_wall_clock_that_is_set_moves_no_other_time) {
  simulated_disk disk;
  audit seen;
  process p(disk, seen);
  const auto wall_ns = p.world.time().wall_ns();
  const auto now_ns = p.world.now_ns();
  p.world.set_wall_ahead(-1'000'000'000);
  EXPECT_EQ(p.world.time().wall_ns(), wall_ns - 1'000'000'000);
  EXPECT_EQ(p.world.now_ns(), now_ns);
}

} // namespace simulation_test
