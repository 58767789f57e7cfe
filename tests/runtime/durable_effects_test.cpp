// The corners of durable effects: several receivers, full mailboxes, handlers that throw half way, timers.
#include <gtest/gtest.h>

#include "runtime/define_message.hpp"
#include "runtime/random.hpp"
#include "runtime/simulation/simulation.hpp"
#include "tests/support/ledger.hpp"

namespace durable_effects_test {

using namespace godwit;
using namespace godwit::runtime;
using namespace godwit::tests;
using namespace std::chrono_literals;

constexpr std::int64_t unlucky_amount = 13; // the core throws on it, once
constexpr std::int64_t unlucky_key = 77;    // letting its receipt out throws, once

// Crashes that happen once, counted outside the actor.
struct bad_luck {
  int in_core = 1;
  int in_dispatch_effect = 1;
};
bad_luck luck;

void throw_once(int& left, const char* what) {
  if (left > 0) {
    --left;
    throw std::runtime_error(what);
  }
}

struct twin_core {
  struct state {
    std::int64_t deposits = 0;
    static constexpr int version = 1;
    static constexpr auto fields = io::table("test.twin_state", io::field("deposits", &state::deposits));
  };
  using event = std::variant<deposit, withdraw>;
  using effect = std::variant<receipt, withdrawn>;

  static std::vector<effect> apply(state& s, const event& happened, std::int64_t) {
    if (const auto* d = std::get_if<deposit>(&happened))
      return {receipt{d->key, ++s.deposits}};
    const auto& w = std::get<withdraw>(happened);
    if (w.amount == unlucky_amount)
      throw_once(luck.in_core, "in the core");
    return {withdrawn{w.key, true}, receipt{w.key, 0}};
  }
  static std::vector<effect> resume(const state&, std::int64_t) { return {}; }
};

using twin_handle = mailbox<tells<deposit>, asks<withdraw, withdrawn>>;

// Tells each receipt to two actors.
class twin_actor final : public durable_actor<twin_handle, twin_core> {
public:
  twin_actor(spawn_context context, auditor_handle first, auditor_handle second)
      : durable_actor(std::move(context)), first_(std::move(first)), second_(std::move(second)) {}

protected:
  behavior_type handlers() override { return {on_event<deposit>(), on_request<withdraw, withdrawn>()}; }
  void dispatch(const effect& each) override {
    const auto& r = std::get<receipt>(each);
    if (r.key == unlucky_key)
      throw_once(luck.in_dispatch_effect, "letting out");
    tell(first_, r);
    tell(second_, r);
  }

private:
  auditor_handle first_;
  auditor_handle second_;
};

child_policy patient_child() {
  child_policy result;
  result.restart.intensity = 1000;
  return result;
}

child_policy given_up_at_once() {
  child_policy result;
  result.restart.intensity = 0;
  return result;
}

struct twin_world {
  explicit twin_world(const child_policy& second_policy = patient_child()) : world(disk, 1, {}, false) {
    luck = {};
    const auto first = world.actors().add<auditor_actor>({.name = "first"}, patient_child(), &seen_first);
    const auto second = world.actors().add<auditor_actor>({.name = "second"}, second_policy, &seen_second);
    twin = world.actors().add<twin_actor>({.name = "twin"}, patient_child(), first, second);
    world.start();
    world.run_until_idle();
  }
  [[nodiscard]] std::size_t unreleased() { return disk.actors["twin"].kept.effects.size(); }

  simulated_disk disk;
  audit seen_first;
  audit seen_second;
  simulation world;
  twin_handle twin;
};

TEST(durable_effects, an_effect_told_to_two_actors_is_released_when_both_have_it) {
  twin_world w;
  w.world.tell(w.twin, deposit{1, 1});
  w.world.run_until_idle();
  EXPECT_EQ(w.seen_first.receipts[1], 1);
  EXPECT_EQ(w.seen_second.receipts[1], 1);
  EXPECT_EQ(w.unreleased(), 0U);
}

TEST(durable_effects, two_confirmations_of_one_receiver_do_not_stand_for_the_other) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    random_source random(seed);
    twin_world w(given_up_at_once());
    w.world.kill("second");
    w.world.advance(1s);
    w.world.tell(w.twin, deposit{1, 1});
    for (int i = 0; i < 12; ++i) {
      w.world.step(random.next());
      if (random.below(4) == 0)
        w.world.kill("twin");
    }
    w.world.advance(120s);
    ASSERT_EQ(w.unreleased(), 1U) << "the second never had it; seed " << seed;
  }
}

// The child is given up; two effects for it are decided, and a table revives it.
TEST(durable_effects, effects_for_a_child_that_was_given_up_wait_and_reach_it_once_when_it_is_back) {
  twin_world w(given_up_at_once());
  const auto table = [&](std::uint64_t n, std::uint64_t revivals) {
    (void)w.world.ask(w.world.actors().guardian(), 1s, supervise{{1, n}, revivals, {}});
    w.world.run_until_idle();
  };
  table(1, 0);
  EXPECT_TRUE(w.world.kill("second"));
  w.world.run_until_idle();
  w.world.tell(w.twin, deposit{1, 1});
  w.world.tell(w.twin, deposit{2, 1});
  w.world.advance(1min);
  EXPECT_EQ(w.unreleased(), 2U) << "nobody confirms for a child that is away";
  table(2, 1);
  EXPECT_EQ(w.seen_second.receipts[1], 1);
  EXPECT_EQ(w.seen_second.receipts[2], 1);
  EXPECT_EQ(w.seen_first.receipts[1], 1);
  EXPECT_EQ(w.unreleased(), 0U);
  EXPECT_EQ(w.world.counters("twin").crashes, 0U) << "their sender needs no crash for it";
}

TEST(durable_effects, effects_for_a_child_that_is_not_wanted_outlive_the_process) {
  twin_world w;
  (void)w.world.ask(w.world.actors().guardian(), 1s, supervise{{1, 1}, 0, {{"second", false, patient_child()}}});
  w.world.run_until_idle();
  w.world.tell(w.twin, deposit{1, 1});
  w.world.run_until_idle();
  EXPECT_EQ(w.unreleased(), 1U);
  audit seen;
  simulation next(w.disk, 2, {}, false);
  const auto first = next.actors().add<auditor_actor>({.name = "first"}, patient_child(), &w.seen_first);
  const auto second = next.actors().add<auditor_actor>({.name = "second"}, patient_child(), &seen);
  (void)next.actors().add<twin_actor>({.name = "twin"}, patient_child(), first, second);
  next.start();
  next.run_until_idle();
  EXPECT_EQ(seen.receipts[1], 1);
  EXPECT_EQ(w.unreleased(), 0U);
}

TEST(durable_effects, a_request_whose_core_throws_once_is_answered_once_and_well) {
  twin_world w;
  const auto asked = w.world.ask(w.twin, 10s, withdraw{5, unlucky_amount});
  w.world.advance(2s);
  EXPECT_EQ(asked->answers, 1);
  EXPECT_EQ(asked->failures, 0) << asked->failure.what;
  EXPECT_EQ(w.world.counters("twin").requeued, 1U);
}

TEST(durable_effects, an_answer_survives_a_throw_later_in_the_same_batch) {
  twin_world w;
  const auto asked = w.world.ask(w.twin, 10s, withdraw{unlucky_key, 1});
  w.world.advance(2s);
  EXPECT_EQ(asked->answers, 1);
  EXPECT_EQ(w.seen_first.receipts[unlucky_key], 1);
  EXPECT_EQ(w.unreleased(), 0U);
}

TEST(durable_effects, a_full_mailbox_still_hears_that_its_events_are_durable) {
  simulated_disk disk;
  audit seen;
  simulation world(disk, 1);
  const auto auditor = world.actors().add<auditor_actor>({.name = "auditor"}, patient_child(), &seen);
  address_options narrow;
  narrow.name = "ledger";
  narrow.mailbox_bound = 5;
  const auto ledger = world.actors().add<ledger_actor>(narrow, patient_child(), auditor);
  world.start();
  world.run_until_idle();
  world.tell(ledger, deposit{1, 5});
  world.step(0); // handled; its event waits at the journal
  for (int i = 0; i < 5; ++i)
    (void)world.ask(ledger, 10s, get_balance{});
  world.journal().step(); // "durable" comes upon a full mailbox
  world.advance(1s);
  EXPECT_EQ(seen.receipts[1], 1);
}

TEST(durable_effects, what_the_journal_says_between_two_incarnations_reaches_the_next) {
  simulated_disk disk;
  audit seen;
  simulation world(disk, 1);
  const auto auditor = world.actors().add<auditor_actor>({.name = "auditor"}, patient_child(), &seen);
  const auto ledger = world.actors().add<ledger_actor>({.name = "ledger"}, patient_child(), auditor);
  world.start();
  world.run_until_idle();
  world.journal().fail_writes(true);
  world.tell(ledger, deposit{1, 5});
  world.step(0);
  world.kill("ledger");
  world.step(0);                       // it ends
  world.step(0);                       // the guardian asks the journal to recover it
  ASSERT_TRUE(world.journal().step()); // recovered from the overlay; the write still waits
  world.journal().fail_writes(false);
  ASSERT_TRUE(world.journal().step()); // now it is durable, and nobody is there to hear it
  world.advance(1s);
  EXPECT_EQ(seen.receipts[1], 1);
}

TEST(durable_effects, an_actor_whose_effects_nobody_confirms_takes_no_more_events_than_its_bound) {
  twin_world w(given_up_at_once());
  luck.in_dispatch_effect = 0;
  w.world.kill("second");
  w.world.advance(1s);
  for (std::size_t i = 0; i < max_unreleased_effects + 50; ++i) {
    w.world.tell(w.twin, deposit{static_cast<std::int64_t>(i) + 1, 1});
    w.world.run_until_idle();
  }
  EXPECT_EQ(w.unreleased(), max_unreleased_effects);
  EXPECT_EQ(w.world.counters("twin").crashes, 0U) << "it waits";
  const auto asked = w.world.ask(w.twin, 1s, withdraw{5, 1});
  w.world.run_until_idle();
  EXPECT_EQ(asked->failures, 1) << "an ask is refused at once";
}

// Sets a timer while it lets an effect out.
struct timer_core {
  struct state {
    std::int64_t set = 0;
    static constexpr int version = 1;
    static constexpr auto fields = io::table("test.timer_state", io::field("set", &state::set));
  };
  using event = std::variant<deposit>;
  using effect = std::variant<receipt>;
  static std::vector<effect> apply(state& s, const event& happened, std::int64_t) {
    const auto& d = std::get<deposit>(happened);
    ++s.set;
    return {receipt{d.key, d.amount}};
  }
  static std::vector<effect> resume(const state&, std::int64_t) { return {}; }
};

class timer_actor final : public durable_actor<mailbox<tells<deposit>>, timer_core> {
public:
  timer_actor(spawn_context context, auditor_handle auditor)
      : durable_actor(std::move(context)), auditor_(std::move(auditor)) {}

protected:
  behavior_type handlers() override { return {on_event<deposit>()}; }
  void dispatch(const effect& each) override {
    const auto& r = std::get<receipt>(each);
    tell_after(std::chrono::seconds(r.balance_after), auditor_, r);
  }

private:
  auditor_handle auditor_;
};

TEST(durable_effects, timers_set_while_letting_out_arrive_in_any_order) {
  simulated_disk disk;
  audit seen;
  simulation world(disk, 1);
  const auto auditor = world.actors().add<auditor_actor>({.name = "auditor"}, patient_child(), &seen);
  const auto timer = world.actors().add<timer_actor>({.name = "timer"}, patient_child(), auditor);
  world.start();
  world.run_until_idle();
  world.tell(timer, deposit{1, 5});
  world.tell(timer, deposit{2, 1});
  world.advance(20s);
  EXPECT_EQ(seen.receipts[1], 1);
  EXPECT_EQ(seen.receipts[2], 1);
}

} // namespace durable_effects_test
