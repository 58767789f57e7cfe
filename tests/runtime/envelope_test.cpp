#include "runtime/envelope.hpp"

#include <string>

#include <gtest/gtest.h>

#include "runtime/actor_base.hpp"
#include "runtime/address/stable_address.hpp"
#include "runtime/caf_mail.hpp"
#include "runtime/define_message.hpp"
#include "runtime/simulation/simulation.hpp"
#include "tests/runtime/foreign_type.hpp"

namespace envelope_test {

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
struct long_text {
  std::string text;
  static constexpr auto fields = io::table("test.long_text", io::field("text", &long_text::text));
};

using adder_handle = mailbox<tells<add>, asks<get_sum, sum>>;
// Believes that the adder answers with a long text.
using mistaken_handle = mailbox<asks<get_sum, long_text>>;

static_assert(accepts<adder_handle, add> && accepts<adder_handle, get_sum>);
static_assert(!accepts<adder_handle, sum>);
static_assert(std::is_same_v<answer_t<adder_handle, get_sum>, sum>);
static_assert(std::is_convertible_v<adder_handle, mailbox<tells<add>>>, "a handle narrows");
static_assert(!std::is_convertible_v<mailbox<tells<add>>, adder_handle>, "and does not widen");
static_assert(!std::is_convertible_v<adder_handle, mistaken_handle>, "the answer is part of the message");
static_assert(std::is_same_v<combine<mailbox<tells<add>>, adder_handle>, adder_handle>, "each message once");

class adder final : public actor_base<adder_handle> {
public:
  using actor_base::actor_base;

protected:
  behavior_type handlers() override {
    return {on<add>([this](const add& a) { sum_ += a.by; }), on<get_sum>([this](const get_sum&) { return sum{sum_}; })};
  }

private:
  int sum_ = 0;
};

struct world_of_adder {
  world_of_adder() : world(disk, 1), handle(world.actors().add<adder>({.name = "adder"}, {})) {
    world.start();
    world.run_until_idle();
  }
  [[nodiscard]] health_colour colour() const {
    for (const auto& each : world.health().entries())
      if (each.component == "adder")
        return each.colour;
    return health_colour::red;
  }
  simulated_disk disk;
  simulation world;
  adder_handle handle;
};

TEST(envelope, a_small_body_lies_inside_and_a_large_one_is_shared) {
  const auto small = envelope::of({1, 0, 0, 0, 0}, add{4});
  const auto copy = small; // NOLINT(performance-unnecessary-copy-initialization): the copy is what is tested
  EXPECT_EQ(copy.as<add>().by, 4);
  EXPECT_NE(copy.body.data(), small.body.data());
  const auto large = envelope::of({1, 0, 0, 0, 0}, long_text{std::string(1000, 'x')});
  const auto shared = large; // NOLINT(performance-unnecessary-copy-initialization)
  EXPECT_EQ(shared.body.data(), large.body.data());
  EXPECT_EQ(shared.as<long_text>().text.size(), 1000U);
}

TEST(envelope, a_type_of_the_same_name_from_another_shared_object_is_refused_and_counted) {
  world_of_adder w;
  envelope foreign;
  godwit_make_foreign_add(&foreign);
  EXPECT_EQ(foreign.type->name, "test.add");
  EXPECT_FALSE(foreign.is<add>());
  strong(w.handle.ref())->enqueue(make_mail(nullptr, caf::make_message_id(), foreign), nullptr);
  w.world.tell(w.handle, add{2});
  w.world.run_until_idle();
  EXPECT_EQ(w.world.counters("adder").not_accepted, 1U);
  EXPECT_EQ(w.world.counters("adder").crashes, 0U);
  EXPECT_EQ(w.colour(), health_colour::yellow);
  const auto asked = w.world.ask(w.handle, 1s, get_sum{});
  w.world.run_until_idle();
  EXPECT_EQ(asked->answer.value, 2);
}

// Asks with a handle that has the wrong answer in it, as a shared object of another version would.
using asker_handle = mailbox<tells<add>>;

class asker final : public actor_base<asker_handle> {
public:
  asker(spawn_context context, mistaken_handle whom, std::string* outcome)
      : actor_base(std::move(context)), whom_(std::move(whom)), outcome_(outcome) {}

protected:
  behavior_type handlers() override {
    return {on<add>([this](const add&) {
      ask(
          whom_, 1s, get_sum{}, [this](const long_text& t) { *outcome_ = t.text; },
          [this](const ask_error& why) { *outcome_ = why.what; });
    })};
  }

private:
  mistaken_handle whom_;
  std::string* outcome_;
};

TEST(envelope, an_answer_of_another_type_than_was_asked_for_is_an_error_and_counted) {
  simulated_disk disk;
  simulation world(disk, 1);
  std::string outcome;
  const auto counting = world.actors().add<adder>({.name = "adder"}, {});
  const auto asking = world.actors().add<asker>({.name = "asker"}, {}, mistaken_handle(counting.ref()), &outcome);
  world.start();
  world.tell(asking, add{1});
  world.advance(2s);
  EXPECT_EQ(outcome, "asker was answered with test.sum where it had asked for test.long_text");
  EXPECT_EQ(world.counters("asker").not_accepted, 1U);
  EXPECT_EQ(world.counters("asker").crashes, 0U);
}

} // namespace envelope_test
