// What an actor takes and does beside its mailbox, run again: it comes from the record, and is held against it.
#include <deque>
#include <memory>
#include <optional>
#include <utility>

#include <gtest/gtest.h>

#include "runtime/replay/replayer.hpp"
#include "runtime/simulation/simulation.hpp"
#include "tests/support/delivery_list.hpp"
#include "tests/support/ledger.hpp"

namespace beside_test {

using namespace godwit;
using namespace godwit::runtime;
using namespace godwit::tests;
using namespace std::chrono_literals;

using weights = std::deque<withdraw>;

// At each deposit it takes what lies in a queue, shows the sum times FACTOR to the world, and tells it. Without a
// durable state: a new incarnation begins at 0. Takes one less of the queue where it is LAZY.
template <int Factor, bool Lazy = false>
class scale final : public actor_base<relay_handle> {
public:
  scale(spawn_context context, auditor_handle auditor, std::shared_ptr<weights> queue)
      : actor_base(std::move(context)), auditor_(std::move(auditor)), queue_(std::move(queue)) {}

protected:
  behavior_type handlers() override {
    return {on<deposit>([this](const deposit& d) {
      if (!Lazy)
        while (const auto next = take_beside<withdraw>([this] { return next_weight(); }))
          sum_ += next->amount;
      note_call_with("show", balance{sum_ * Factor, 0, {}});
      tell(auditor_, receipt{d.key, sum_});
    })};
  }

private:
  std::optional<withdraw> next_weight() {
    if (queue_->empty())
      return std::nullopt;
    auto result = queue_->front();
    queue_->pop_front();
    return result;
  }

  auditor_handle auditor_;
  std::shared_ptr<weights> queue_;
  std::int64_t sum_ = 0;
};

class recorded_scale {
public:
  recorded_scale() {
    simulated_disk disk;
    simulation world(disk, 1, &record_);
    record_.begin_process(world.names(), world.time());
    const auto auditor = world.actors().add<auditor_actor>({.name = "auditor"}, {}, &seen_);
    const auto weighed = world.actors().add<scale<1>>({.name = "scale"}, {}, auditor, queue_);
    world.start();
    world.run_until_idle();
    for (std::int64_t key = 1; key <= 4; ++key) {
      queue_->push_back({key, 10 * key});
      queue_->push_back({key, key});
      if (key == 3)
        (void)world.kill("scale");
      world.advance(2s);
      world.tell(weighed, deposit{key, 0});
      world.advance(20ms);
    }
  }

  template <class Actor>
  replay_summary replay() {
    actor_bench bench(1);
    const auto auditor = bench.actors().add<auditor_actor>({.name = "auditor"}, {}, &seen_);
    (void)bench.actors().add<Actor>({.name = "scale"}, {}, auditor, std::make_shared<weights>());
    EXPECT_TRUE(bench.choose("scale"));
    kept_.emplace("scale", record_.names);
    record_.for_each(1, [&](const delivery& each) { kept_->add(each); });
    kept_->finish();
    return replayer(bench, *kept_, {.monotonic_to_utc_ns = simulated_time::start_ns}).run([](const replay_step&) {});
  }

private:
  delivery_list record_;
  audit seen_;
  std::shared_ptr<weights> queue_ = std::make_shared<weights>();
  std::optional<recorded_run> kept_;
};

TEST(replay_beside, inputs_come_from_the_record_and_calls_are_compared_in_each_incarnation) {
  recorded_scale made;
  const auto found = made.replay<scale<1>>();
  EXPECT_TRUE(found.deviations.empty());
  EXPECT_EQ(found.incarnations, 2U);
  EXPECT_EQ(found.left_out, 0U);
  EXPECT_EQ(found.compared, 8U); // a call and a receipt for each
}

TEST(replay_beside, another_call_is_a_deviation) {
  recorded_scale made;
  const auto found = made.replay<scale<2>>();
  ASSERT_EQ(found.deviations.size(), 1U);
  EXPECT_EQ(found.deviations[0].kind, deviation_kind::differs);
  ASSERT_NE(found.deviations[0].expected, nullptr);
  EXPECT_EQ(found.deviations[0].expected->type, "runtime.outside_call");
  ASSERT_EQ(found.deviations[0].fields.size(), 1U);
  EXPECT_EQ(found.deviations[0].fields[0].field, "hash");
}

TEST(replay_beside, an_input_that_is_not_taken_is_a_deviation) {
  recorded_scale made;
  auto found = made.replay<scale<1, true>>();
  ASSERT_EQ(found.deviations.size(), 1U);
  EXPECT_EQ(found.deviations[0].input->type, "test.deposit");
}

} // namespace beside_test
