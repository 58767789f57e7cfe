// operator_bridge as an actor: crashes at each point, a killed process, a disk that fails.
#include "actors/operator_bridge/actor.hpp"

#include <gtest/gtest.h>

#include <array>

#include "runtime/simulation/simulation.hpp"
#include "tests/support/audit_rows.hpp"

namespace godwit::operator_bridge {
namespace operator_bridge_actor_test {

using namespace std::chrono_literals;
using operators::command_kind;
using operators::role;
using runtime::crash_point;

constexpr std::array points{crash_point::before_handler, crash_point::after_handler, crash_point::after_commit,
                            crash_point::before_dispatch};

const operators::principal local{"desk", role::engineer, std::string(operators::local_session)};

// Takes all that it is told, or is silent.
class executor_stand_in final : public runtime::actor_base<executor_handle> {
public:
  executor_stand_in(runtime::spawn_context context, std::vector<operators::command>* heard, const bool* answers)
      : actor_base(std::move(context)), heard_(heard), answers_(answers) {}

protected:
  behavior_type handlers() override {
    return {
        on_deferred<operators::command, operators::answer>([this](const operators::command& m, std::uint64_t request) {
          heard_->push_back(m);
          if (*answers_)
            answer_later(request, operators::answer{true, {}, {}});
        })};
  }

private:
  std::vector<operators::command>* heard_;
  const bool* answers_;
};

// Hears who has control.
class listener_stand_in final : public runtime::actor_base<control_listener> {
public:
  listener_stand_in(runtime::spawn_context context, std::vector<std::string>* heard)
      : actor_base(std::move(context)), heard_(heard) {}

protected:
  behavior_type handlers() override {
    return {on<control_news>([this](const control_news& m) { heard_->push_back(m.holder); })};
  }

private:
  std::vector<std::string>* heard_;
};

struct process {
  explicit process(runtime::simulated_disk& disk, std::uint64_t seed = 1) : on(&disk), world(disk, seed) {
    const auto executor = world.actors().add<executor_stand_in>({.name = "executor"}, {}, &heard, &answers);
    const auto listener = world.actors().add<listener_stand_in>({.name = "ground_port"}, {}, &control);
    bridge = world.actors().add<actor>({.name = "operator_bridge"}, {}, settings{}, executor_handle(executor), shown,
                                       std::vector<control_listener>{listener}, ends);
    world.start();
    world.run_until_idle();
  }
  [[nodiscard]] operator_command command(command_kind kind, const std::string& id = {}) const {
    operator_command result;
    result.id = id;
    result.by = local;
    result.what.kind = kind;
    return result;
  }
  std::shared_ptr<runtime::asked<command_answer>> say(const operator_command& m) {
    auto asked = world.ask(bridge, 4s, m);
    world.run_until_idle();
    return asked;
  }
  std::vector<audit_row> audit() {
    world.run_until_idle();
    return audit_support::audit_rows(*on).read({0, 100}).rows;
  }
  runtime::simulated_disk* on;
  std::vector<operators::command> heard;
  std::vector<std::string> control; // who has it, as it was told
  std::shared_ptr<presence> shown = std::make_shared<presence>();
  std::shared_ptr<session_ends> ends = std::make_shared<session_ends>();
  bool answers = true;
  runtime::simulation world;
  own_handle bridge;
};

TEST(operator_bridge, a_command_is_handed_over_when_it_is_on_the_disk_and_answered_when_its_outcome_is) {
  runtime::simulated_disk disk;
  process p(disk);
  p.world.journal().hold(true);
  const auto asked = p.say(p.command(command_kind::start, "a"));
  EXPECT_TRUE(p.heard.empty());
  p.world.journal().hold(false);
  p.world.run_until_idle();
  ASSERT_EQ(asked->answers, 1);
  EXPECT_EQ(asked->answer.verdict, verdict::taken);
  EXPECT_EQ(p.heard.size(), 1U);
  EXPECT_EQ(p.audit().back().outcome, "taken");
}

TEST(operator_bridge, who_has_control_is_told_when_it_is_on_the_disk_and_by_each_incarnation) {
  runtime::simulated_disk disk;
  process p(disk);
  EXPECT_EQ(p.control, (std::vector<std::string>{""}));
  p.world.journal().hold(true);
  (void)p.world.ask(p.bridge, 1s, change_control{local, control_act::take, {}});
  p.world.run_until_idle();
  EXPECT_EQ(p.control.size(), 1U) << "it may never have been";
  p.world.journal().hold(false);
  p.world.run_until_idle();
  EXPECT_EQ(p.control, (std::vector<std::string>{"", "desk"}));
  p.world.kill("operator_bridge");
  p.world.advance(1s);
  EXPECT_EQ(p.control.back(), "desk");
  EXPECT_EQ(p.control.size(), 3U);
  p.world.advance(11s);
  EXPECT_EQ(p.control.back(), "") << "who has it is silent";
  EXPECT_TRUE(p.shown->is_there(p.world.time().monotonic_ns() - 12'000'000'000));
  EXPECT_FALSE(p.shown->is_there(p.world.time().monotonic_ns()));
}

TEST(operator_bridge, a_stop_waits_for_no_disk) {
  runtime::simulated_disk disk;
  process p(disk);
  p.world.journal().fail_writes(true);
  for (const auto kind : {command_kind::pause, command_kind::come_home}) {
    const auto asked = p.say(p.command(kind));
    EXPECT_EQ(asked->answer.verdict, verdict::taken);
  }
  EXPECT_EQ(p.heard.size(), 2U);
  p.world.journal().fail_writes(false);
  p.world.journal().refuse_writes(true);
  EXPECT_EQ(p.say(p.command(command_kind::pause))->answer.verdict, verdict::taken);
  EXPECT_EQ(p.say(p.command(command_kind::pause))->answer.verdict, verdict::taken);
  EXPECT_EQ(p.say(p.command(command_kind::start))->answer.verdict, verdict::busy);
  EXPECT_EQ(p.heard.size(), 4U);
}

TEST(operator_bridge,
     a_crash_at_any_point_has_no_command_done_twice_and_it_is_answered_the_same_when_it_is_said_again) {
  for (const auto point : points) {
    runtime::simulated_disk disk;
    process p(disk);
    p.world.crash_at("operator_bridge", point);
    (void)p.say(p.command(command_kind::start, "a"));
    p.world.advance(1s);
    const auto second = p.say(p.command(command_kind::start, "a"));
    p.world.advance(3s);
    const auto third = p.say(p.command(command_kind::start, "a"));
    EXPECT_EQ(p.world.counters("operator_bridge").crashes, 1U) << static_cast<int>(point);
    EXPECT_LE(p.heard.size(), 1U) << static_cast<int>(point);
    ASSERT_EQ(second->answers, 1) << static_cast<int>(point);
    EXPECT_EQ(second->answer, third->answer) << static_cast<int>(point);
    EXPECT_TRUE(second->answer.verdict == verdict::unknown || p.heard.size() == 1U) << static_cast<int>(point);
  }
}

TEST(operator_bridge, a_killed_process_has_no_command_done_twice_wherever_it_was) {
  for (std::uint64_t steps = 0; steps < 40; ++steps) {
    runtime::simulated_disk disk;
    std::size_t done = 0;
    {
      process p(disk);
      (void)p.world.ask(p.bridge, 4s, p.command(command_kind::start, "a"));
      for (std::uint64_t i = 0; i < steps && p.world.step(i); ++i) {
      }
      done = p.heard.size();
    } // killed
    process again(disk, 2);
    const auto asked = again.say(again.command(command_kind::start, "a"));
    ASSERT_EQ(asked->answers, 1) << steps;
    EXPECT_LE(done + again.heard.size(), 1U) << steps;
    EXPECT_FALSE(again.audit().empty()) << steps;
  }
}

TEST(operator_bridge, who_is_logged_in_and_who_has_control_is_known_after_a_kill_at_once) {
  runtime::simulated_disk disk;
  operators::principal anna;
  {
    process p(disk);
    const auto opened = p.world.ask(p.bridge, 1s, open_session{{"anna", role::operator_, "x", {}}, "hash", "here"});
    p.world.run_until_idle();
    anna = opened->answer.who;
    const auto taken = p.world.ask(p.bridge, 1s, change_control{anna, control_act::take, {}});
    p.world.run_until_idle();
    ASSERT_TRUE(taken->answer.is_done);
  } // killed
  process again(disk, 2);
  const auto known = again.world.ask(again.bridge, 1s, identify{"hash"});
  again.world.run_until_idle();
  EXPECT_EQ(known->answer.who, anna);
  auto command = again.command(command_kind::resume, "r");
  command.by = anna;
  EXPECT_EQ(again.say(command)->answer.verdict, verdict::taken);
  again.world.advance(11s);
  const auto who = again.world.ask(again.bridge, 1s, get_operators{});
  again.world.run_until_idle();
  EXPECT_FALSE(who->answer.control);
}

TEST(operator_bridge, who_shows_something_to_a_session_hears_that_its_account_is_gone) {
  runtime::simulated_disk disk;
  process p(disk);
  std::vector<std::string> over;
  p.ends->listen([&](const std::string& session) { over.push_back(session); });
  const auto opened = p.world.ask(p.bridge, 1s, open_session{{"anna", role::viewer, "stamp", {}}, "hash", "here"});
  p.world.run_until_idle();
  p.world.tell(p.bridge, accounts_read{{{"anna", role::viewer, "stamp", {}}}});
  p.world.run_until_idle();
  EXPECT_TRUE(over.empty());
  p.world.tell(p.bridge, accounts_read{});
  p.world.run_until_idle();
  EXPECT_EQ(over, (std::vector<std::string>{opened->answer.who.session}));
}

TEST(operator_bridge, an_executor_that_is_silent_leaves_the_outcome_unknown) {
  runtime::simulated_disk disk;
  process p(disk);
  p.answers = false;
  const auto asked = p.say(p.command(command_kind::start, "a"));
  p.world.advance(3s);
  EXPECT_EQ(asked->answer.verdict, verdict::unknown);
}

} // namespace operator_bridge_actor_test
} // namespace godwit::operator_bridge
