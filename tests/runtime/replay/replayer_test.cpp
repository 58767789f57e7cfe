// A recorded ledger run again: it does the same through crashes and a restart of the process; a ledger whose core was
// changed, or a record that was, deviates at the first message at which that shows.
#include "runtime/replay/replayer.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "runtime/simulation/simulation.hpp"
#include "tests/support/delivery_list.hpp"
#include "tests/support/ledger.hpp"

namespace replayer_test {

using namespace godwit;
using namespace godwit::runtime;
using namespace godwit::tests;
using namespace std::chrono_literals;

constexpr std::int64_t unlucky = 13; // crashes the ledgers of this test, each time

// A ledger on CORE that crashes on unlucky deposits.
template <class Core>
class fragile_ledger final : public durable_actor<ledger_handle, Core> {
  using base = durable_actor<ledger_handle, Core>;

public:
  fragile_ledger(spawn_context context, auditor_handle auditor) : base(std::move(context)), auditor_(auditor) {}

protected:
  typename base::behavior_type handlers() override {
    return {this->template on<deposit>([this](const deposit& d) {
              if (d.amount == unlucky)
                throw std::runtime_error("an unlucky deposit");
              this->commit(typename Core::event(d));
            }),
            this->template on_request<withdraw, withdrawn>(),
            this->template on<get_balance>([this](const get_balance&) {
              return balance{this->current_state().amount, this->current_state().deposits, {}};
            })};
  }
  void dispatch(const typename Core::effect& each) override {
    if (const auto* r = std::get_if<receipt>(&each))
      this->tell(auditor_, *r);
    else if (const auto* a = std::get_if<tests::alarm>(&each))
      this->tell(auditor_, *a);
  }

private:
  auditor_handle auditor_;
};

// As after a change of the code: from the sum of 40 on each receipt is one too high.
struct changed_core : ledger_core {
  static std::vector<effect> apply(state& s, const event& happened, std::int64_t at_ns) {
    auto result = ledger_core::apply(s, happened, at_ns);
    constexpr std::int64_t shows_from = 40;
    if (auto* r = result.empty() ? nullptr : std::get_if<receipt>(&result.front());
        r != nullptr && s.amount >= shows_from)
      ++r->balance_after;
    return result;
  }
};

child_policy patient() {
  child_policy result;
  result.restart.intensity = 1000;
  return result;
}

// What all of it is recorded of.
class recorded_world {
public:
  // One process: a deposit of each AMOUNT in turn, each until nothing happens any more.
  void live(const std::vector<std::int64_t>& amounts,
            const std::function<void(simulation&, std::size_t)>& between = {}) {
    simulation world(disk_, 1, &record);
    record.begin_process(world.names(), world.time());
    const auto auditor = world.actors().add<auditor_actor>({.name = "auditor"}, patient(), &seen_);
    const auto ledger = world.actors().add<fragile_ledger<ledger_core>>({.name = "ledger"}, patient(), auditor);
    const auto front = world.actors().add<relay_actor>({.name = "relay"}, patient(), ledger);
    world.start();
    world.run_until_idle();
    for (std::size_t n = 0; n < amounts.size(); ++n) {
      if (between)
        between(world, n);
      world.tell(front, deposit{++key_, amounts[n]});
      world.advance(20ms);
    }
    world.advance(1s);
  }

  template <class Core>
  replay_summary replay(std::uint64_t run, replay_options options = {}) {
    actor_bench bench(run);
    const auto auditor = bench.actors().add<auditor_actor>({.name = "auditor"}, patient(), &seen_);
    (void)bench.actors().add<fragile_ledger<Core>>({.name = "ledger"}, patient(), auditor);
    EXPECT_TRUE(bench.choose("ledger"));
    kept.emplace("ledger", record.names);
    record.for_each(run, [&](const delivery& each) { kept->add(each); });
    kept->finish();
    options.monotonic_to_utc_ns = simulated_time::start_ns;
    return replayer(bench, *kept, options).run([this](const replay_step& step) { steps += step.is_same ? 1 : 0; });
  }

  delivery_list record;
  std::optional<recorded_run> kept;
  std::size_t steps = 0; // that were the same

private:
  simulated_disk disk_;
  audit seen_;
  std::int64_t key_ = 0;
};

TEST(replayer, what_was_recorded_is_done_again) {
  recorded_world made;
  made.live({10, 20, 1'000, 5});
  const auto found = made.replay<ledger_core>(1);
  EXPECT_TRUE(found.deviations.empty());
  EXPECT_EQ(found.compared, 5U); // a receipt for each, and an alarm
  EXPECT_EQ(found.incarnations, 1U);
  EXPECT_EQ(found.unconfirmed, 0U);
  EXPECT_EQ(made.steps, found.inputs);
}

TEST(replayer, a_crash_happens_again_at_the_same_message_each_time) {
  recorded_world made;
  made.live({10, unlucky, 20});
  const auto found = made.replay<ledger_core>(1);
  EXPECT_TRUE(found.deviations.empty());
  EXPECT_EQ(found.crashes, static_cast<std::size_t>(max_crashes));
  EXPECT_EQ(found.incarnations, 1U + max_crashes);
  EXPECT_EQ(found.compared, 2U);
}

TEST(replayer, a_process_that_was_restored_from_the_journal_goes_on_from_what_it_was_given) {
  recorded_world made;
  made.live({10, 20});
  made.live({30}, [](simulation& world, std::size_t) { (void)world.kill("ledger"); });
  const auto found = made.replay<ledger_core>(2);
  EXPECT_TRUE(found.deviations.empty());
  EXPECT_EQ(found.incarnations, 2U);
  EXPECT_GE(found.compared, 1U);
  EXPECT_EQ(found.left_out, 0U);
}

TEST(replayer, a_crash_that_a_test_planned_is_left_out_and_the_rest_is_compared) {
  recorded_world made;
  made.live({10, 20, 30}, [](simulation& world, std::size_t n) {
    if (n == 1)
      world.crash_at("ledger", crash_point::after_handler);
  });
  const auto found = made.replay<ledger_core>(1);
  EXPECT_TRUE(found.deviations.empty());
  EXPECT_EQ(found.planned_crashes, 1U);
  EXPECT_EQ(found.incarnations, 2U);
  EXPECT_EQ(found.compared, 3U);
}

// As if the mistake had been mended since.
TEST(replayer, a_crash_that_does_not_come_again_is_a_deviation) {
  recorded_world made;
  made.live({10, 20, 30}, [](simulation& world, std::size_t n) {
    if (n == 1)
      world.crash_at("ledger", crash_point::before_handler);
  });
  for (auto& each : made.record.all)
    if (const auto at = each.body.find("planned by the test"); at != each.body.npos)
      each.body.replace(at, 7, "meant it");
  const auto found = made.replay<ledger_core>(1);
  ASSERT_EQ(found.deviations.size(), 1U);
  EXPECT_EQ(found.deviations[0].kind, deviation_kind::crashed);
  EXPECT_EQ(found.deviations[0].what, "meant it by the test");
}

TEST(replayer, a_changed_core_deviates_at_the_first_message_at_which_it_shows) {
  recorded_world made;
  made.live({10, 20, 30, 40});
  const auto found = made.replay<changed_core>(1);
  ASSERT_EQ(found.deviations.size(), 1U);
  const auto& first = found.deviations[0];
  EXPECT_EQ(first.kind, deviation_kind::differs);
  ASSERT_NE(first.expected, nullptr);
  EXPECT_EQ(first.expected->body, R"({"key":3,"balance_after":60})");
  ASSERT_EQ(first.fields.size(), 1U);
  EXPECT_EQ(first.fields[0].field, "balance_after");
  EXPECT_EQ(first.fields[0].produced, "61");
}

TEST(replayer, all_deviations_of_a_change_are_found_where_all_are_asked_for) {
  recorded_world made;
  made.live({10, 20, 30, 40});
  EXPECT_EQ(made.replay<changed_core>(1, {.max_deviations = 100}).deviations.size(), 2U);
}

TEST(replayer, a_message_that_was_taken_out_of_the_record_is_missed_and_one_that_was_put_in_too) {
  recorded_world made;
  made.live({10, 20, 30});
  const auto receipts = made.record.names.number("test.receipt");
  auto& all = made.record.all;
  const auto first = std::ranges::find_if(all, [&](const auto& each) { return each.what.type == receipts; });
  const auto copy = *first;
  all.erase(first);
  const auto extra = made.replay<ledger_core>(1);
  ASSERT_EQ(extra.deviations.size(), 1U);
  EXPECT_EQ(extra.deviations[0].kind, deviation_kind::not_recorded);
  all.push_back(copy);
  all.push_back(copy);
  all.back().what.id += 1U << 20U;
  const auto missing = made.replay<ledger_core>(1);
  ASSERT_EQ(missing.deviations.size(), 1U);
  EXPECT_EQ(missing.deviations[0].kind, deviation_kind::not_sent);
}

TEST(replayer, it_ends_after_the_message_that_was_named) {
  recorded_world made;
  made.live({10, 20, 30, 40});
  (void)made.replay<ledger_core>(1);
  const auto all = made.kept->inputs();
  const auto until = std::ranges::find(all, std::string("test.deposit"), &recorded_message::type)->id;
  EXPECT_LT(made.replay<ledger_core>(1, {.until = until}).inputs, all.size());
}

TEST(replayer, an_incarnation_whose_beginning_was_cut_off_is_left_out_and_said) {
  recorded_world made;
  made.live({10, 20, 30}, [](simulation& world, std::size_t n) {
    if (n == 2)
      (void)world.kill("ledger");
  });
  const auto restored = made.record.names.number("runtime.restored");
  const auto begin = std::ranges::find(made.record.all, restored, [](const auto& each) { return each.what.type; });
  made.record.all.erase(made.record.all.begin(), begin + 1);
  const auto found = made.replay<ledger_core>(1);
  EXPECT_TRUE(found.deviations.empty());
  EXPECT_EQ(found.left_out, 1U);
  EXPECT_EQ(found.incarnations, 1U);
  ASSERT_EQ(found.notes.size(), 1U);
}

} // namespace replayer_test
