#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <set>

#include "runtime/supervision/supervision_core.hpp"

namespace supervision_core_test {

using namespace godwit::runtime;
using namespace std::chrono_literals;

// An action as one word: "start 0", "stop 2 for good", "wait 1 100 ms".
struct to_word {
  std::string operator()(const start_child& a) const { return "start " + std::to_string(a.child); }
  std::string operator()(const stop_child& a) const {
    return "stop " + std::to_string(a.child) + (a.for_good ? " for good" : "");
  }
  std::string operator()(const await_restart& a) const {
    return "wait " + std::to_string(a.child) + ' ' + std::to_string(a.delay_ns / 1'000'000) + " ms";
  }
  std::string operator()(const give_up_child& a) const { return "give up " + std::to_string(a.child); }
  std::string operator()(const bring_down& a) const { return "bring down " + std::to_string(a.child); }
  std::string operator()(const all_stopped&) const { return "all stopped"; }
};

using words = std::vector<std::string>;

words in_words(const supervision_core::actions& actions) {
  words result;
  for (const auto& each : actions)
    result.push_back(std::visit(to_word{}, each));
  return result;
}

child_policy policy_with(std::uint32_t intensity, bool essential = false) {
  child_policy result;
  result.essential = essential;
  result.restart.intensity = intensity;
  result.restart.jitter = 0;
  return result;
}

// Three children, all of them running.
supervision_core three_running(strategy how, std::uint32_t intensity = 3, bool essential = false) {
  supervision_core core(how, std::vector<child_policy>(3, policy_with(intensity, essential)), 1);
  (void)core.start();
  for (std::size_t i = 0; i < core.size(); ++i)
    (void)core.up(i);
  return core;
}

void expect_phases(const supervision_core& core, const std::vector<child_phase>& expected) {
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(godwit::io::name_of(core.phase(i)), godwit::io::name_of(expected[i])) << "child " << i;
}

constexpr auto absent = child_phase::absent;
constexpr auto starting = child_phase::starting;
constexpr auto running = child_phase::running;
constexpr auto stopping = child_phase::stopping;
constexpr auto given_up = child_phase::given_up;

TEST(supervision_core, a_child_is_started_only_when_the_one_before_it_is_up) {
  for (const auto how : {strategy::one_for_one, strategy::rest_for_one}) {
    supervision_core core(how, std::vector<child_policy>(3, policy_with(3)), 1);
    EXPECT_EQ(in_words(core.start()), words{"start 0"});
    expect_phases(core, {starting, absent, absent});
    EXPECT_EQ(in_words(core.up(0)), words{"start 1"});
    EXPECT_EQ(in_words(core.up(1)), words{"start 2"});
    EXPECT_EQ(in_words(core.up(2)), words{});
    expect_phases(core, {running, running, running});
  }
}

TEST(supervision_core, a_child_that_crashes_while_starting_keeps_the_later_ones_waiting_when_it_is_essential) {
  supervision_core core(strategy::one_for_one, std::vector<child_policy>(2, policy_with(3, true)), 1);
  (void)core.start();
  EXPECT_EQ(in_words(core.down(0, 0)), words{"start 0"});
  EXPECT_EQ(in_words(core.down(0, 0)), words{"wait 0 100 ms"});
  EXPECT_EQ(in_words(core.restart_due(0)), words{"start 0"});
  EXPECT_EQ(in_words(core.up(0)), words{"start 1"});
  EXPECT_EQ(core.restarts(0), 0U) << "it had never been up before";
}

TEST(supervision_core,
     a_child_that_crashes_at_each_start_keeps_nobody_waiting_when_it_is_not_essential_or_never_given_up) {
  for (const auto& policy : {policy_with(3), policy_with(restart_policy::for_ever, true)}) {
    supervision_core core(strategy::one_for_one, {policy, policy_with(3)}, 1);
    (void)core.start();
    EXPECT_EQ(in_words(core.down(0, 0)), words{"start 0"});
    const auto second = in_words(core.down(0, 0));
    ASSERT_EQ(second.size(), 2U);
    EXPECT_EQ(second.back(), "start 1");
    (void)core.up(1);
    EXPECT_EQ(in_words(core.restart_due(0)), words{"start 0"});
    EXPECT_EQ(in_words(core.up(0)), words{});
  }
}

TEST(supervision_core, one_for_one_starts_only_the_crashed_child_again) {
  auto core = three_running(strategy::one_for_one);
  EXPECT_EQ(in_words(core.down(0, 0)), words{"start 0"});
  expect_phases(core, {starting, running, running});
  EXPECT_EQ(in_words(core.up(0)), words{});
  EXPECT_EQ(core.restarts(0), 1U);
  EXPECT_EQ(core.restarts(1), 0U);
}

TEST(supervision_core, one_for_one_starts_crashed_children_again_without_an_order) {
  auto core = three_running(strategy::one_for_one);
  EXPECT_EQ(in_words(core.down(0, 0)), words{"start 0"});
  EXPECT_EQ(in_words(core.down(2, 0)), words{"start 2"}) << "it has been up before and needs not wait for child 0";
}

TEST(supervision_core, rest_for_one_stops_the_later_ones_in_reverse_one_at_a_time_and_starts_all_in_order) {
  auto core = three_running(strategy::rest_for_one);
  EXPECT_EQ(in_words(core.down(0, 0)), words{"stop 2"});
  EXPECT_EQ(in_words(core.down(2, 0)), words{"stop 1"});
  EXPECT_EQ(in_words(core.down(1, 0)), words{"start 0"});
  EXPECT_EQ(in_words(core.up(0)), words{"start 1"});
  EXPECT_EQ(in_words(core.up(1)), words{"start 2"});
  EXPECT_EQ(in_words(core.up(2)), words{});
  expect_phases(core, {running, running, running});
}

TEST(supervision_core, rest_for_one_leaves_the_earlier_ones_alone) {
  auto core = three_running(strategy::rest_for_one);
  EXPECT_EQ(in_words(core.down(1, 0)), words{"stop 2"});
  EXPECT_EQ(in_words(core.down(2, 0)), words{"start 1"});
  expect_phases(core, {running, starting, absent});
}

TEST(supervision_core, a_stop_for_another_is_not_a_crash) {
  auto core = three_running(strategy::rest_for_one, 1);
  (void)core.down(0, 0);
  (void)core.down(2, 0);
  (void)core.down(1, 0);
  (void)core.up(0);
  (void)core.up(1);
  (void)core.up(2);
  EXPECT_EQ(in_words(core.down(2, 1)), words{"start 2"}) << "its first crash";
}

TEST(supervision_core, stopping_goes_in_reverse_order_and_is_told_once) {
  for (const auto how : {strategy::one_for_one, strategy::rest_for_one}) {
    auto core = three_running(how);
    EXPECT_EQ(in_words(core.shutdown()), words{"stop 2 for good"});
    EXPECT_EQ(in_words(core.shutdown()), words{}) << "asked again";
    EXPECT_EQ(in_words(core.down(2, 0)), words{"stop 1 for good"});
    EXPECT_EQ(in_words(core.down(1, 0)), words{"stop 0 for good"});
    EXPECT_EQ(in_words(core.down(0, 0)), words{"all stopped"});
    EXPECT_EQ(in_words(core.shutdown()), words{});
    EXPECT_EQ(in_words(core.restart_due(0)), words{});
    expect_phases(core, {absent, absent, absent});
  }
}

TEST(supervision_core, an_essential_child_that_is_given_up_brings_the_process_down) {
  auto core = three_running(strategy::one_for_one, 1, true);
  EXPECT_EQ(in_words(core.down(1, 0)), words{"start 1"});
  EXPECT_EQ(in_words(core.down(1, 1)), (words{"give up 1", "bring down 1"}));
  expect_phases(core, {running, given_up, running});
}

TEST(supervision_core, a_child_given_up_that_is_not_essential_leaves_the_rest_running) {
  auto core = three_running(strategy::one_for_one, 1);
  (void)core.down(0, 0);
  EXPECT_EQ(in_words(core.down(0, 1)), words{"give up 0"});
  expect_phases(core, {given_up, running, running});
  EXPECT_EQ(in_words(core.down(2, 2)), words{"start 2"});
}

TEST(supervision_core, a_child_given_up_before_it_was_ever_up_does_not_keep_the_later_ones_from_starting) {
  supervision_core core(strategy::one_for_one, std::vector<child_policy>(2, policy_with(0)), 1);
  (void)core.start();
  EXPECT_EQ(in_words(core.down(0, 0)), (words{"give up 0", "start 1"}));
}

TEST(supervision_core, it_has_begun_when_each_child_has_been_up_or_was_given_up) {
  supervision_core core(strategy::one_for_one, std::vector<child_policy>(3, policy_with(0)), 1);
  EXPECT_FALSE(core.has_begun());
  (void)core.start();
  (void)core.up(0);
  (void)core.down(1, 0);
  EXPECT_FALSE(core.has_begun());
  (void)core.up(2);
  EXPECT_TRUE(core.has_begun());
  (void)core.down(2, 0);
  EXPECT_TRUE(core.has_begun());
}

TEST(supervision_core, unreadable_state_gives_a_child_up_at_its_first_crash) {
  auto core = three_running(strategy::one_for_one, 100, true);
  EXPECT_EQ(in_words(core.down(2, 0, true)), (words{"give up 2", "bring down 2"}));
}

TEST(supervision_core, with_rest_for_one_nothing_runs_after_a_child_given_up) {
  auto core = three_running(strategy::rest_for_one, 0);
  EXPECT_EQ(in_words(core.down(1, 0)), (words{"give up 1", "stop 2"}));
  EXPECT_EQ(in_words(core.down(2, 0)), words{});
  expect_phases(core, {running, given_up, absent});
}

TEST(supervision_core, an_unwanted_child_is_stopped_and_started_when_it_is_wanted_again) {
  auto core = three_running(strategy::one_for_one);
  EXPECT_EQ(in_words(core.want(1, false)), words{"stop 1 for good"});
  EXPECT_EQ(in_words(core.down(1, 0)), words{});
  expect_phases(core, {running, absent, running});
  EXPECT_EQ(in_words(core.want(1, true)), words{"start 1"});
}

TEST(supervision_core, a_child_wanted_again_while_it_stops_is_started_when_it_is_down) {
  auto core = three_running(strategy::one_for_one);
  (void)core.want(1, false);
  EXPECT_EQ(in_words(core.want(1, true)), words{});
  EXPECT_EQ(in_words(core.down(1, 0)), words{"start 1"});
}

TEST(supervision_core, nobody_waits_for_an_unwanted_child) {
  supervision_core core(strategy::rest_for_one, std::vector<child_policy>(3, policy_with(3)), 1);
  EXPECT_EQ(in_words(core.want(0, false)), words{}) << "not started yet";
  EXPECT_EQ(in_words(core.start()), words{"start 1"});
}

TEST(supervision_core, a_child_given_up_that_is_revived_starts_with_its_crashes_forgotten) {
  auto core = three_running(strategy::one_for_one, 1);
  (void)core.down(0, 0);
  (void)core.up(0);
  EXPECT_EQ(in_words(core.down(0, 1)), words{"give up 0"});
  EXPECT_EQ(in_words(core.revive(0)), words{"start 0"});
  EXPECT_EQ(in_words(core.down(0, 2)), words{"start 0"}) << "the first crash of a new period";
}

TEST(supervision_core, wanting_a_child_that_was_given_up_does_not_start_it) {
  auto core = three_running(strategy::one_for_one, 1);
  (void)core.down(0, 0);
  (void)core.up(0);
  (void)core.down(0, 1);
  EXPECT_EQ(in_words(core.want(0, true)), words{});
  EXPECT_EQ(in_words(core.want(0, false)), words{});
  EXPECT_EQ(in_words(core.want(0, true)), words{});
  expect_phases(core, {given_up, running, running});
}

TEST(supervision_core, wanting_a_child_again_keeps_its_crash_history) {
  auto core = three_running(strategy::one_for_one, 2);
  (void)core.down(0, 0);
  (void)core.up(0);
  (void)core.want(0, false);
  (void)core.down(0, 1);
  EXPECT_EQ(in_words(core.want(0, true)), words{"start 0"});
  EXPECT_EQ(in_words(core.down(0, 2)), words{"wait 0 100 ms"}) << "its second crash";
}

TEST(supervision_core, reviving_changes_nothing_for_a_child_that_was_not_given_up) {
  auto core = three_running(strategy::one_for_one, 3);
  (void)core.down(0, 0);
  (void)core.up(0);
  (void)core.down(0, 1);
  EXPECT_EQ(in_words(core.revive(0)), words{}) << "it waits";
  EXPECT_EQ(in_words(core.revive(1)), words{}) << "it runs";
  EXPECT_EQ(in_words(core.restart_due(0)), words{"start 0"});
}

TEST(supervision_core, a_child_that_stops_does_not_delay_the_restart_of_another) {
  auto core = three_running(strategy::one_for_one);
  EXPECT_EQ(in_words(core.want(1, false)), words{"stop 1 for good"});
  EXPECT_EQ(in_words(core.down(0, 0)), words{"start 0"}) << "while child 1 hangs in its stop";
  EXPECT_EQ(in_words(core.down(2, 0)), words{"start 2"});
}

TEST(supervision_core, a_child_that_stops_does_not_delay_the_first_start_of_another) {
  supervision_core core(strategy::one_for_one, std::vector<child_policy>(2, policy_with(3)), 1);
  (void)core.start();
  EXPECT_EQ(in_words(core.want(0, false)), (words{"stop 0 for good", "start 1"}));
  EXPECT_EQ(in_words(core.want(0, true)), words{}) << "it starts when it has stopped";
  EXPECT_EQ(in_words(core.down(1, 0)), words{"start 1"});
  EXPECT_EQ(in_words(core.down(0, 0)), words{"start 0"});
}

TEST(supervision_core, a_child_that_is_restarted_for_ever_is_not_given_up_and_waits_the_longest_wait) {
  supervision_core core(strategy::one_for_one, {policy_with(restart_policy::for_ever)}, 1);
  (void)core.start();
  std::int64_t now_ns = 0;
  words last;
  for (int i = 0; i < 100; ++i) {
    (void)core.up(0);
    last = in_words(core.down(0, now_ns));
    now_ns += 5'000'000'000;
    (void)core.restart_due(0);
  }
  EXPECT_EQ(last, words{"wait 0 5000 ms"});
}

TEST(supervision_core, an_unwanted_child_in_its_back_off_is_not_started_when_it_is_due) {
  auto core = three_running(strategy::one_for_one);
  (void)core.down(1, 0);
  (void)core.up(1);
  EXPECT_EQ(in_words(core.down(1, 1)), words{"wait 1 100 ms"});
  EXPECT_EQ(in_words(core.want(1, false)), words{});
  EXPECT_EQ(in_words(core.restart_due(1)), words{});
  expect_phases(core, {running, absent, running});
}

TEST(supervision_core, shutdown_during_a_back_off_does_not_wait_for_it) {
  supervision_core core(strategy::one_for_one, {policy_with(3)}, 1);
  (void)core.start();
  (void)core.up(0);
  (void)core.down(0, 0);
  (void)core.up(0);
  EXPECT_EQ(in_words(core.down(0, 1)), words{"wait 0 100 ms"});
  EXPECT_EQ(in_words(core.shutdown()), words{"all stopped"});
  EXPECT_EQ(in_words(core.restart_due(0)), words{}) << "the timer that still runs";
  expect_phases(core, {absent});
}

TEST(supervision_core, shutdown_stops_a_child_that_is_starting) {
  supervision_core core(strategy::one_for_one, std::vector<child_policy>(2, policy_with(3)), 1);
  (void)core.start();
  EXPECT_EQ(in_words(core.shutdown()), words{"stop 0 for good"});
  EXPECT_EQ(in_words(core.up(0)), words{}) << "on its way before the stop";
  expect_phases(core, {stopping, absent});
  EXPECT_EQ(in_words(core.down(0, 0)), words{"all stopped"});
}

TEST(supervision_core, a_crash_during_shutdown_starts_and_escalates_nothing) {
  auto core = three_running(strategy::one_for_one, 0, true);
  (void)core.shutdown();
  EXPECT_EQ(in_words(core.down(0, 0)), words{"give up 0"}) << "no bring_down: the process is on its way out";
  EXPECT_EQ(in_words(core.down(2, 0)), words{"stop 1 for good"});
  EXPECT_EQ(in_words(core.down(1, 0)), words{"all stopped"});
}

TEST(supervision_core, a_second_crash_during_shutdown_waits_for_nothing) {
  supervision_core core(strategy::one_for_one, std::vector<child_policy>(2, policy_with(3)), 1);
  (void)core.start();
  (void)core.up(0);
  (void)core.down(0, 0);
  (void)core.up(0);
  EXPECT_EQ(in_words(core.shutdown()), words{"stop 1 for good"});
  EXPECT_EQ(in_words(core.down(0, 1)), words{}) << "no back-off for what is not started again";
  EXPECT_EQ(in_words(core.down(1, 1)), words{"all stopped"});
  expect_phases(core, {absent, absent});
}

TEST(supervision_core, set_policy_changes_what_the_next_crash_means) {
  auto core = three_running(strategy::one_for_one, 100);
  core.set_policy(1, policy_with(0, true));
  EXPECT_EQ(in_words(core.down(1, 0)), (words{"give up 1", "bring down 1"}));
}

TEST(supervision_core, events_that_do_not_fit_the_phase_change_nothing) {
  auto core = three_running(strategy::one_for_one, 0);
  (void)core.down(0, 0); // given up
  EXPECT_EQ(in_words(core.down(0, 1)), words{});
  EXPECT_EQ(in_words(core.up(0)), words{});
  EXPECT_EQ(in_words(core.up(1)), words{});
  EXPECT_EQ(in_words(core.restart_due(1)), words{});
  expect_phases(core, {given_up, running, running});
}

// -- any order of events
// -----------------------------------------------------------------------------------------------

// Drives a core policy_with events that are possible, and holds its actions against the rules.
class world_of_children {
public:
  world_of_children(strategy how, std::size_t children, std::uint64_t seed)
      : how_(how), core_(how, std::vector<child_policy>(children, policy_with(3)), seed), children_(children) {}

  void start() { take(core_.start()); }
  void want(std::size_t i, bool wanted) {
    children_[i].wanted = wanted;
    if (!wanted)
      children_[i].excused = true;
    take(core_.want(i, wanted));
  }
  void shutdown() {
    shutting_down_ = true;
    take(core_.shutdown());
  }

  // Lets something happen to child I, chosen by CHOICE among what is possible for it now.
  void happen(std::size_t i, std::uint32_t choice, std::int64_t now_ns) {
    auto& each = children_[i];
    if (each.due && (!each.alive || choice % 2 == 0)) {
      each.due = false;
      take(core_.restart_due(i));
    } else if (each.alive && !each.up && choice % 3 != 0) {
      each.up = true;
      each.been_up = true;
      take(core_.up(i));
    } else if (each.alive) {
      end(i, now_ns);
    }
  }

  // Everything that is outstanding comes to its end, without further crashes.
  void resolve(std::int64_t now_ns) {
    for (bool moved = true; moved;) {
      moved = false;
      for (std::size_t i = 0; i < children_.size(); ++i) {
        auto& each = children_[i];
        if (each.due || (each.alive && each.told_to_stop) || (each.alive && !each.up)) {
          moved = true;
          if (each.alive && each.told_to_stop)
            end(i, now_ns);
          else
            happen(i, each.due ? 0 : 1, now_ns);
        }
      }
    }
  }

  void expect_resolved() const {
    for (std::size_t i = 0; i < children_.size(); ++i) {
      const auto phase = core_.phase(i);
      RC_ASSERT(phase == running || phase == absent || phase == given_up);
      RC_ASSERT((phase == running) == children_[i].alive);
      if (!children_[i].wanted || shutting_down_)
        RC_ASSERT(phase != running);
      else if (how_ == strategy::one_for_one)
        RC_ASSERT(phase != absent);
      if (how_ == strategy::rest_for_one && phase == running)
        for (std::size_t before = 0; before < i; ++before)
          RC_ASSERT(!children_[before].wanted || core_.phase(before) == running);
    }
    RC_ASSERT(all_stopped_ == (shutting_down_ ? 1 : 0));
  }

private:
  struct child {
    bool alive = false; // started and not down yet
    bool up = false;
    bool been_up = false;
    bool excused = false; // unwanted, given up or waiting once: later ones need not wait for it
    bool wanted = true;
    bool due = false; // a timer runs
    bool told_to_stop = false;
  };

  void end(std::size_t i, std::int64_t now_ns) {
    children_[i].alive = false;
    children_[i].up = false;
    children_[i].told_to_stop = false;
    take(core_.down(i, now_ns));
  }

  void take(const supervision_core::actions& actions) {
    for (const auto& each : actions)
      std::visit([this](const auto& action) { check(action); }, each);
  }

  void check(const start_child& a) {
    auto& each = children_[a.child];
    RC_ASSERT(!shutting_down_);
    RC_ASSERT(each.wanted);
    RC_ASSERT(!each.alive); // never twice without a down in between
    each.alive = true;
    for (std::size_t before = 0; before < a.child; ++before)
      RC_ASSERT(children_[before].been_up || children_[before].excused);
    if (how_ == strategy::rest_for_one)
      for (std::size_t before = 0; before < a.child; ++before)
        RC_ASSERT(!children_[before].wanted || (children_[before].up && !children_[before].told_to_stop));
  }
  void check(const stop_child& a) {
    auto& each = children_[a.child];
    RC_ASSERT(each.alive);
    RC_ASSERT(!each.told_to_stop);
    for (const auto& other : children_)
      RC_ASSERT(!other.told_to_stop); // one at a time
    if (shutting_down_)
      for (std::size_t after = a.child + 1; after < children_.size(); ++after)
        RC_ASSERT(!children_[after].alive); // in reverse order
    RC_ASSERT(a.for_good == (shutting_down_ || !each.wanted));
    each.told_to_stop = true;
  }
  void check(const await_restart& a) {
    RC_ASSERT(!children_[a.child].alive);
    RC_ASSERT(!children_[a.child].due);
    RC_ASSERT(!shutting_down_);
    RC_ASSERT(a.delay_ns > 0);
    children_[a.child].due = true;
    children_[a.child].excused |= how_ == strategy::one_for_one;
  }
  void check(const give_up_child& a) {
    RC_ASSERT(!children_[a.child].alive);
    children_[a.child].excused = true;
  }
  void check(const bring_down&) { RC_FAIL("no child is essential"); }
  void check(const all_stopped&) {
    RC_ASSERT(shutting_down_);
    for (const auto& each : children_)
      RC_ASSERT(!each.alive);
    ++all_stopped_;
  }

  strategy how_;
  supervision_core core_;
  std::vector<child> children_;
  bool shutting_down_ = false;
  int all_stopped_ = 0;
};

RC_GTEST_PROP(supervision_core, keeps_its_rules_whatever_happens, ()) {
  const auto how = *rc::gen::element(strategy::one_for_one, strategy::rest_for_one);
  const auto children = *rc::gen::inRange<std::size_t>(1, 6);
  world_of_children world(how, children, *rc::gen::arbitrary<std::uint64_t>());
  world.start();
  const auto choices = *rc::gen::container<std::vector<std::uint32_t>>(rc::gen::arbitrary<std::uint32_t>());
  const auto shutdown_at = *rc::gen::inRange<std::size_t>(0, choices.size() * 2 + 1);
  std::int64_t now_ns = 0;
  for (std::size_t step = 0; step < choices.size(); ++step) {
    const auto choice = choices[step];
    const auto child = choice % children;
    now_ns += (choice >> 8U) % 20 * 1'000'000'000;
    if (step == shutdown_at)
      world.shutdown();
    else if (choice >> 4U & 7U)
      world.happen(child, choice >> 16U, now_ns);
    else
      world.want(child, (choice >> 7U) % 3 != 0);
  }
  world.resolve(now_ns);
  world.expect_resolved();
  world.shutdown();
  world.resolve(now_ns);
  world.expect_resolved();
}

} // namespace supervision_core_test
