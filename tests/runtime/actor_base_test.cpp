#include <gtest/gtest.h>

#include "runtime/actor_base.hpp"
#include "runtime/define_message.hpp"
#include "runtime/simulation/simulation.hpp"

namespace actor_base_test {

using namespace godwit;
using namespace godwit::runtime;
using namespace std::chrono_literals;

struct add {
  int by = 0;
  static constexpr auto fields = io::table("test.add", io::field("by", &add::by));
};
struct get_sum {
  static constexpr auto fields = io::table("test.get_sum");
};
struct sum {
  int value = 0;
  static constexpr auto fields = io::table("test.sum", io::field("value", &sum::value));
};

using counter_handle = mailbox<tells<add>, asks<get_sum, sum>>;

// A counter whose memory is outside, so that a test sees every time a handler ran to its end.
class counter final : public actor_base<counter_handle> {
public:
  counter(spawn_context context, int* total) : actor_base(std::move(context)), total_(total) {}

protected:
  behavior_type handlers() override {
    return {on<add>([this](const add& m) {
              if (m.by == 13)
                throw std::runtime_error("unlucky");
              *total_ += m.by;
            }),
            on<get_sum>([this](const get_sum&) { return sum{*total_}; })};
  }

private:
  int* total_;
};

using relay_handle = mailbox<tells<add>, asks<get_sum, sum>>;

class relay final : public actor_base<relay_handle> {
public:
  relay(spawn_context context, counter_handle next) : actor_base(std::move(context)), next_(std::move(next)) {}

protected:
  behavior_type handlers() override {
    return {on<add>([this](const add& m) { tell(next_, m); }),
            on_deferred<get_sum, sum>([this](const get_sum& q, std::uint64_t request) {
              ask(
                  next_, 1s, q, [this, request](const sum& s) { answer_later(request, s); },
                  [this, request](const ask_error&) { answer_later(request, sum{-1}); });
            })};
  }

private:
  counter_handle next_;
};

// Ticks every 10 ms, each tick by the one before.
class ticker final : public actor_base<counter_handle> {
public:
  ticker(spawn_context context, int* ticks) : actor_base(std::move(context)), ticks_(ticks) {}

protected:
  behavior_type handlers() override {
    return {on<add>([](const add&) {}), on<get_sum>([this](const get_sum&) { return sum{*ticks_}; })};
  }
  void started() override { wake_at(now_ns() + 10'000'000); }
  void on_deadline() override {
    ++*ticks_;
    wake_at(now_ns() + 10'000'000);
  }

private:
  int* ticks_;
};

address_options address(std::string name, on_crash policy) {
  address_options result;
  result.name = std::move(name);
  result.policy = policy;
  return result;
}

struct world_of_two {
  explicit world_of_two(on_crash policy = on_crash::redeliver) : world(disk, 1) {
    sums = world.actors().add<counter>(address("counter", policy), {.essential = false, .restart = {.intensity = 100}},
                                       &total);
    front =
        world.actors().add<relay>(address("relay", policy), {.essential = false, .restart = {.intensity = 100}}, sums);
    world.start();
    world.run_until_idle();
  }
  simulated_disk disk;
  int total = 0;
  simulation world;
  counter_handle sums;
  relay_handle front;
};

TEST(actor_base, tells_and_asks_reach_the_handlers) {
  world_of_two w;
  w.world.tell(w.front, add{2});
  w.world.tell(w.front, add{3});
  w.world.run_until_idle();
  EXPECT_EQ(w.total, 5);
  const auto direct = w.world.ask(w.sums, 1s, get_sum{});
  const auto through = w.world.ask(w.front, 1s, get_sum{});
  w.world.run_until_idle();
  EXPECT_EQ(direct->answer.value, 5);
  EXPECT_EQ(through->answer.value, 5);
  EXPECT_EQ(through->answers, 1);
}

TEST(actor_base, a_message_that_crashes_its_handler_once_ends_as_handled) {
  for (const auto point : {crash_point::before_handler, crash_point::after_handler}) {
    world_of_two w;
    w.world.crash_at("relay", point);
    w.world.tell(w.front, add{2});
    w.world.advance(1s);
    EXPECT_EQ(w.total, 2) << "sent twice or not at all";
    EXPECT_EQ(w.world.counters("relay").crashes, 1U);
    EXPECT_EQ(w.world.counters("relay").requeued, 1U);
    EXPECT_EQ(w.world.counters("relay").handled, 1U);
  }
}

TEST(actor_base, the_third_crash_on_a_message_makes_it_a_dead_letter_and_the_actor_goes_on) {
  world_of_two w;
  w.world.tell(w.sums, add{1});
  w.world.tell(w.sums, add{13});
  w.world.tell(w.sums, add{4});
  w.world.advance(10s);
  EXPECT_EQ(w.total, 5);
  ASSERT_EQ(w.disk.dead_letters.size(), 1U);
  const auto& letter = w.disk.dead_letters[0];
  EXPECT_EQ(letter.type, "test.add");
  EXPECT_EQ(letter.body, R"({"by":13})");
  EXPECT_EQ(letter.reason, "unlucky");
  EXPECT_EQ(letter.attempts, max_crashes);
  EXPECT_EQ(letter.sender, "test");
  const auto counters = w.world.counters("counter");
  EXPECT_EQ(counters.crashes, 3U);
  EXPECT_EQ(counters.handled, 2U);
  EXPECT_EQ(counters.dead_lettered, 1U);
  EXPECT_EQ(counters.accepted, 3U);
}

TEST(actor_base, policy_lose_gives_up_what_was_queued_and_counts_it) {
  world_of_two w(on_crash::lose);
  w.world.tell(w.sums, add{1});
  w.world.tell(w.sums, add{13});
  w.world.tell(w.sums, add{4});
  const auto asked_in_vain = w.world.ask(w.sums, 1s, get_sum{});
  w.world.advance(10s);
  EXPECT_EQ(w.total, 1);
  EXPECT_EQ(asked_in_vain->failures, 1);
  EXPECT_EQ(asked_in_vain->failure.code, ask_errc::not_taken);
  EXPECT_EQ(w.world.counters("counter").lost, 3U);
  EXPECT_EQ(w.world.counters("counter").handled, 1U);
}

TEST(actor_base, a_request_put_back_is_answered_by_the_next_incarnation_once) {
  world_of_two w;
  w.world.crash_at("counter", crash_point::after_handler);
  const auto asked = w.world.ask(w.sums, 5s, get_sum{});
  w.world.advance(1s);
  EXPECT_EQ(asked->answers, 1);
  EXPECT_EQ(asked->failures, 0);
}

TEST(actor_base, a_request_that_always_crashes_is_answered_with_given_up) {
  world_of_two w;
  for (int i = 0; i < max_crashes; ++i)
    w.world.crash_at("counter", crash_point::before_handler);
  const auto asked = w.world.ask(w.sums, 60s, get_sum{});
  w.world.advance(10s);
  EXPECT_EQ(asked->failures, 1);
  EXPECT_EQ(asked->failure.code, ask_errc::given_up);
}

TEST(actor_base, a_deferred_answer_lost_with_its_incarnation_is_told_as_outcome_unknown) {
  world_of_two w;
  const auto asked = w.world.ask(w.front, 60s, get_sum{});
  ASSERT_TRUE(w.world.step(0)); // the relay has asked on
  EXPECT_TRUE(w.world.kill("relay"));
  w.world.advance(2s);
  EXPECT_EQ(asked->answers, 0);
  EXPECT_EQ(asked->failures, 1);
  EXPECT_EQ(asked->failure.code, ask_errc::outcome_unknown);
}

TEST(actor_base, a_killed_actor_loses_no_mail_with_redeliver) {
  world_of_two w;
  for (int i = 0; i < 10; ++i) {
    w.world.tell(w.front, add{1});
    w.world.kill("relay");
    w.world.kill("counter");
    w.world.step(static_cast<std::uint64_t>(i));
  }
  w.world.advance(120s);
  EXPECT_EQ(w.total, 10);
}

TEST(actor_base, the_trace_tells_cause_sender_and_outcome_of_each_delivery) {
  world_of_two w;
  w.world.crash_at("relay", crash_point::before_handler);
  w.world.tell(w.front, add{2});
  w.world.advance(1s);
  std::string all;
  for (const auto& line : w.world.trace().lines())
    all += line + '\n';
  EXPECT_NE(all.find(R"(relay/1 <- test #)"), std::string::npos) << all;
  EXPECT_NE(all.find(R"(test.add{"by":2} crashed)"), std::string::npos) << all;
  EXPECT_NE(all.find("relay/2 <- test"), std::string::npos) << all;
  EXPECT_NE(all.find("counter/1 <- relay"), std::string::npos) << all;
}

TEST(actor_base, stop_handles_what_is_queued_then_ends_in_order) {
  world_of_two w;
  for (int i = 0; i < 100; ++i)
    w.world.tell(w.front, add{1});
  EXPECT_TRUE(w.world.stop());
  EXPECT_EQ(w.total, 100);
}

TEST(actor_base, parking_is_bounded_and_what_is_over_it_is_counted) {
  simulated_disk disk;
  int total = 0;
  simulation world(disk, 1);
  const auto sums = world.actors().add<counter>({.name = "counter", .parking_bound = 5}, {}, &total);
  for (int i = 0; i < 8; ++i)
    world.tell(sums, add{1}); // not started yet
  const auto refused = world.ask(sums, 1s, get_sum{});
  world.start();
  world.run_until_idle();
  EXPECT_EQ(total, 5);
  EXPECT_EQ(world.counters("counter").refused, 4U);
  EXPECT_EQ(refused->failure.code, ask_errc::not_taken);
}

TEST(actor_base, a_mailbox_is_bounded_and_what_is_over_it_is_counted) {
  simulated_disk disk;
  int total = 0;
  simulation world(disk, 1);
  const auto sums = world.actors().add<counter>({.name = "counter", .mailbox_bound = 5}, {}, &total);
  world.start();
  world.run_until_idle();
  for (int i = 0; i < 8; ++i)
    world.tell(sums, add{1});
  world.run_until_idle();
  EXPECT_EQ(total, 5);
  EXPECT_EQ(world.counters("counter").refused, 3U);
}

TEST(actor_base, an_actor_whose_mailbox_is_full_still_ticks) {
  simulated_disk disk;
  int ticks = 0;
  simulation world(disk, 1);
  const auto busy = world.actors().add<ticker>({.name = "ticker", .mailbox_bound = 5}, {}, &ticks);
  world.start();
  world.run_until_idle();
  for (int i = 0; i < 8; ++i)
    world.tell(busy, add{1});
  ASSERT_EQ(world.counters("ticker").refused, 3U);
  world.pass_time_until(world.now_ns() + 10'000'000); // the first tick comes upon a full mailbox
  world.advance(85ms);
  EXPECT_EQ(ticks, 9);
}

} // namespace actor_base_test
