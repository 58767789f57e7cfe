// One handler, one write: what is decided together becomes durable together, and goes out after it. Journals that are
// slow, full, or can never take a write.
#include <gtest/gtest.h>

#include "runtime/define_message.hpp"
#include "runtime/simulation/simulation.hpp"
#include "tests/support/ledger.hpp"

namespace durable_write_test {

using namespace godwit;
using namespace godwit::runtime;
using namespace godwit::tests;
using namespace std::chrono_literals;

// Shown to whoever looks, not kept.
struct shown {
  static constexpr auto goes_out = effect_kind::after_commit;
  std::int64_t key = 0;
  static constexpr auto fields = io::table("test.shown", io::field("key", &shown::key));
};

struct pair_core {
  struct state {
    std::int64_t deposits = 0;
    static constexpr int version = 1;
    static constexpr auto fields = io::table("test.pair_state", io::field("deposits", &state::deposits));
  };
  using event = std::variant<deposit>;
  using effect = std::variant<receipt, shown>;

  static std::vector<effect> apply(state& s, const event& happened, std::int64_t) {
    const auto& d = std::get<deposit>(happened);
    ++s.deposits;
    return {shown{d.key}, receipt{d.key, s.deposits}};
  }
  static std::vector<effect> resume(const state&, std::int64_t) { return {}; }
};

using pair_handle = mailbox<tells<deposit>, asks<withdraw, withdrawn>>;

// What it did to the world outside.
struct outside_log {
  std::vector<std::string> lines;
};

// Of each deposit two events, KEY and KEY + 1000, in one handler.
class pair_actor final : public durable_actor<pair_handle, pair_core> {
public:
  pair_actor(spawn_context context, auditor_handle auditor, outside_log* log)
      : durable_actor(std::move(context)), auditor_(std::move(auditor)), log_(log) {}

protected:
  behavior_type handlers() override {
    return {on<deposit>([this](const deposit& d) { take(d); }),
            on_deferred<withdraw, withdrawn>([this](const withdraw& w, std::uint64_t request_id) {
              commit(deposit{w.key, w.amount});
              after_commit([this, w, request_id] { answer_later(request_id, withdrawn{w.key, true}); });
            })};
  }

  void take(const deposit& d) {
    commit(d);
    after_commit([this, d] { log_->lines.push_back("ran " + std::to_string(d.key)); });
    commit(deposit{d.key + 1'000, d.amount});
    at_end([this, d] { log_->lines.push_back("left " + std::to_string(d.key)); });
  }

  void dispatch(const effect& each) override {
    if (const auto* r = std::get_if<receipt>(&each))
      tell(auditor_, *r);
    else
      log_->lines.push_back("shown " + std::to_string(std::get<shown>(each).key));
  }

private:
  auditor_handle auditor_;
  outside_log* log_;
};

child_policy slow_child() {
  child_policy result;
  result.restart.intensity = 1000;
  return result;
}

struct pair_world {
  explicit pair_world() : world(disk, 1) {
    const auto auditor = world.actors().add<auditor_actor>({.name = "auditor"}, slow_child(), &seen);
    pair = world.actors().add<pair_actor>({.name = "pair"}, slow_child(), auditor, &log);
    front = world.actors().add<ledger_actor>({.name = "ledger"}, slow_child(), auditor);
    world.start();
    world.run_until_idle();
  }

  simulated_disk disk;
  audit seen;
  outside_log log;
  simulation world;
  pair_handle pair;
  ledger_handle front;
};

using lines = std::vector<std::string>;

TEST(durable_write, what_one_handler_decides_is_one_write) {
  pair_world w;
  const auto before = w.world.journal().status();
  w.world.tell(w.pair, deposit{1, 5});
  w.world.step(0);
  EXPECT_EQ(w.world.journal().waiting(), 1U);
  w.world.run_until_idle();
  EXPECT_EQ(w.world.journal().status().events - before.events, 2U);
  EXPECT_EQ(w.disk.actors["pair"].kept.last_event, 2);
  EXPECT_EQ(w.seen.receipts[1], 1);
  EXPECT_EQ(w.seen.receipts[1'001], 1);
}

TEST(durable_write, what_waits_for_the_disk_goes_out_in_order_and_the_rest_at_the_end_of_the_handler) {
  pair_world w;
  w.world.journal().fail_writes(true);
  w.world.tell(w.pair, deposit{1, 5});
  w.world.tell(w.pair, deposit{2, 5});
  w.world.run_until_idle();
  EXPECT_EQ(w.log.lines, (lines{"left 1", "left 2"}));
  w.world.journal().fail_writes(false);
  w.world.run_until_idle();
  EXPECT_EQ(w.log.lines,
            (lines{"left 1", "left 2", "shown 1", "ran 1", "shown 1001", "shown 2", "ran 2", "shown 1002"}));
}

TEST(durable_write, a_throw_takes_all_of_it_back) {
  pair_world w;
  w.world.crash_at("pair", crash_point::after_handler);
  w.world.tell(w.pair, deposit{1, 5});
  w.world.advance(1s);
  EXPECT_EQ(w.disk.actors["pair"].kept.last_event, 2) << "handled once in effect";
  EXPECT_EQ(w.log.lines, (lines{"left 1", "shown 1", "ran 1", "shown 1001"}));
}

TEST(durable_write, what_was_not_durable_is_gone_with_a_crash_and_the_receipts_are_not) {
  pair_world w;
  w.world.crash_at("pair", crash_point::after_commit);
  w.world.tell(w.pair, deposit{1, 5});
  w.world.advance(1s);
  EXPECT_EQ(w.log.lines, lines{});
  EXPECT_EQ(w.seen.receipts[1], 1);
  EXPECT_EQ(w.seen.receipts[1'001], 1);
}

// A receiver that was killed with the process before its write was on the disk has to be told again.
TEST(durable_write, an_effect_is_confirmed_only_when_the_write_of_its_receiver_is_on_the_disk) {
  simulated_disk disk;
  audit seen;
  simulation world(disk, 1);
  const auto auditor = world.actors().add<auditor_actor>({.name = "auditor"}, slow_child(), &seen);
  const auto second = world.actors().add<ledger_actor>({.name = "second"}, slow_child(), auditor);
  const auto relay = world.actors().add<relay_actor>({.name = "relay"}, slow_child(), second);
  world.start();
  world.run_until_idle();
  for (int i = 0; i < 3; ++i) {
    world.tell(relay, deposit{i + 1, 5});
    world.run_until_idle();
  }
  EXPECT_EQ(seen.receipts.size(), 3U);
  EXPECT_TRUE(disk.actors["second"].kept.effects.empty());
}

TEST(durable_write, a_full_journal_crashes_nothing_and_loses_nothing) {
  pair_world w;
  w.world.journal().refuse_writes(true);
  for (std::int64_t key = 1; key <= 300; ++key) {
    w.world.tell(w.pair, deposit{key, 5});
    w.world.advance(10ms);
  }
  EXPECT_TRUE(w.seen.receipts.empty());
  EXPECT_EQ(w.world.counters("pair").crashes, 0U);
  w.world.journal().refuse_writes(false);
  w.world.advance(1s);
  EXPECT_EQ(w.seen.receipts.size(), 600U);
  EXPECT_EQ(w.disk.actors["pair"].kept.last_event, 600);
  w.world.tell(w.pair, deposit{2'000, 5});
  w.world.advance(1s);
  EXPECT_EQ(w.disk.actors["pair"].kept.last_event, 602);
}

TEST(durable_write, beyond_its_bound_an_actor_refuses_asks_and_keeps_the_rest_in_order) {
  pair_world w;
  w.world.journal().refuse_writes(true);
  const auto many = static_cast<std::int64_t>(max_unreleased_effects / 2) + 10;
  for (std::int64_t key = 1; key <= many; ++key)
    w.world.tell(w.pair, deposit{key % 1'000 + 2'000 * (key / 1'000), 5});
  const auto asked = w.world.ask(w.pair, 5s, withdraw{999'999, 1});
  w.world.run_until_idle();
  EXPECT_EQ(asked->failures, 1);
  EXPECT_EQ(w.world.counters("pair").crashes, 0U);
  w.world.journal().refuse_writes(false);
  w.world.advance(2s);
  EXPECT_EQ(w.disk.actors["pair"].kept.last_event, 2 * many);
  const auto good = w.world.ask(w.pair, 5s, withdraw{999'999, 1});
  w.world.advance(1s);
  EXPECT_EQ(good->answers, 1);
}

TEST(durable_write, a_crash_while_the_journal_is_full_puts_back_what_was_not_taken) {
  pair_world w;
  w.world.journal().refuse_writes(true);
  for (std::int64_t key = 1; key <= 3; ++key)
    w.world.tell(w.pair, deposit{key, 5});
  w.world.run_until_idle();
  w.world.kill("pair");
  w.world.advance(100ms);
  w.world.journal().refuse_writes(false);
  w.world.advance(2s);
  EXPECT_EQ(w.disk.actors["pair"].kept.last_event, 6);
  EXPECT_EQ(w.seen.receipts.size(), 6U);
  for (const auto& [key, times] : w.seen.receipts)
    EXPECT_EQ(times, 1) << key;
}

TEST(durable_write, a_write_that_can_never_commit_ends_the_incarnation_and_the_messages_come_again) {
  pair_world w;
  w.world.journal().fail_writes(true);
  for (std::int64_t key = 1; key <= 3; ++key)
    w.world.tell(w.pair, deposit{key, 5});
  const auto asked = w.world.ask(w.pair, 20s, withdraw{9, 1});
  w.world.run_until_idle();
  w.world.journal().break_writes_of("pair", 1);
  w.world.journal().fail_writes(false);
  w.world.advance(5s);
  EXPECT_EQ(w.world.counters("pair").crashes, 1U);
  EXPECT_EQ(w.disk.actors["pair"].kept.last_event, 7);
  EXPECT_EQ(w.seen.receipts.size(), 7U);
  for (const auto& [key, times] : w.seen.receipts)
    EXPECT_EQ(times, 1) << key;
  EXPECT_EQ(asked->answers, 1);
}

TEST(durable_write, a_message_whose_write_fails_each_time_is_given_up_and_the_others_go_on) {
  pair_world w;
  w.world.journal().break_writes_of("pair", max_crashes);
  w.world.tell(w.pair, deposit{1, 5});
  w.world.tell(w.pair, deposit{2, 5});
  w.world.advance(5s);
  ASSERT_EQ(w.disk.dead_letters.size(), 1U);
  EXPECT_NE(w.disk.dead_letters.front().reason.find("never commit"), std::string::npos);
  EXPECT_EQ(w.seen.receipts.count(1), 0U);
  EXPECT_EQ(w.seen.receipts[2], 1);
}

} // namespace durable_write_test
