#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/actor_base.hpp"
#include "runtime/define_message.hpp"
#include "runtime/simulation/simulation.hpp"
#include "tests/support/ledger.hpp"

namespace guardian_test {

using namespace godwit;
using namespace godwit::runtime;
using namespace std::chrono_literals;

struct fail {
  static constexpr auto fields = io::table("test.fail");
};
struct count_up {
  static constexpr auto fields = io::table("test.count_up");
};

using worker_handle = mailbox<tells<fail>, tells<count_up>>;

class worker final : public actor_base<worker_handle> {
public:
  worker(spawn_context context, int* counted) : actor_base(std::move(context)), counted_(counted) {}

protected:
  behavior_type handlers() override {
    return {on<fail>([](const fail&) { throw std::runtime_error("told to fail"); }),
            on<count_up>([this](const count_up&) { ++*counted_; })};
  }

private:
  int* counted_;
};

// A child whose constructor throws the first N times.
class late_bloomer final : public actor_base<mailbox<tells<count_up>>> {
public:
  late_bloomer(spawn_context context, int* failures_left) : actor_base(std::move(context)) {
    if ((*failures_left)-- > 0)
      throw std::runtime_error("not yet");
  }

protected:
  behavior_type handlers() override {
    return {on<count_up>([](const count_up&) {})};
  }
};

using boss_handle = mailbox<tells<child_event>, tells<fail>, tells<supervise>>;

// What the boss saw, outside of it, where no crash reaches.
struct boss_notes {
  std::vector<std::string> events;
  std::vector<children> adopted; // the first answer of each incarnation
};

// The actor that supervises: adopts the children at its start, hears of them, sends tables.
class boss final : public actor_base<boss_handle> {
public:
  boss(spawn_context context, guardian_handle guardian, boss_notes* notes)
      : actor_base(std::move(context)), guardian_(std::move(guardian)), notes_(notes) {}

protected:
  behavior_type handlers() override {
    return {on<child_event>([this](const child_event& e) {
              notes_->events.push_back(e.name + ' ' + std::string(io::name_of(e.kind)) + ' ' +
                                       std::to_string(e.incarnation));
            }),
            on<fail>([](const fail&) { throw std::runtime_error("told to fail"); }),
            on<supervise>([this](const supervise& table) {
              ask(
                  guardian_, 1s, table, [](const supervised&) {}, [](const ask_error& why) { FAIL() << why.what; });
            })};
  }
  void started() override {
    ask(
        guardian_, 1s, get_children{}, [this](const children& all) { notes_->adopted.push_back(all); },
        [](const ask_error& why) { FAIL() << why.what; });
  }

private:
  guardian_handle guardian_;
  boss_notes* notes_;
};

child_policy with(std::uint32_t intensity, bool essential = false) {
  child_policy result;
  result.essential = essential;
  result.restart.intensity = intensity;
  result.restart.jitter = 0;
  return result;
}

system_options supervised(strategy how) {
  system_options result;
  result.how = how;
  return result;
}

health_entry health_of(const simulation& world, const std::string& name) {
  for (const auto& each : world.health().entries())
    if (each.component == name)
      return each;
  return {};
}

// The children `first`, `second` and `third`, and what happened to them.
struct world_of_workers {
  explicit world_of_workers(child_policy policy = with(100), strategy how = strategy::one_for_one)
      : world(disk, 1, supervised(how)) {
    for (const std::string name : {"first", "second", "third"})
      workers[name] = world.actors().add<worker>({.name = name}, policy, &counted[name]);
  }
  void start() {
    world.start();
    world.run_until_idle();
  }
  void crash(const std::string& name) {
    world.tell(workers.at(name), fail{});
    world.run_until_idle();
  }
  // "first up 1", in the order in which they happened.
  [[nodiscard]] std::vector<std::string> events() const {
    std::vector<std::string> result;
    for (const auto& line : world.trace().lines())
      if (const auto body = line.find("runtime.child_event{"); body != std::string::npos) {
        const auto at = line.find('{', body);
        const auto event = nlohmann::json::parse(line.substr(at, line.rfind('}') - at + 1));
        result.push_back(event.at("name").get<std::string>() + ' ' + event.at("kind").get<std::string>() + ' ' +
                         std::to_string(event.at("incarnation").get<int>()));
      }
    return result;
  }
  [[nodiscard]] std::vector<std::string> events_after(std::size_t seen) const {
    auto all = events();
    return {all.begin() + static_cast<std::ptrdiff_t>(std::min(seen, all.size())), all.end()};
  }
  [[nodiscard]] child_report report(const std::string& name) {
    const auto asked = world.ask(world.actors().guardian(), 1s, get_children{});
    world.run_until_idle();
    for (const auto& each : asked->answer.list)
      if (each.name == name)
        return each;
    ADD_FAILURE() << "no child " << name;
    return {};
  }
  // A table with one entry; returns the epoch of the table that holds then.
  table_epoch set(table_epoch epoch, const child_entry& entry, std::uint64_t revivals = 0) {
    const auto asked = world.ask(world.actors().guardian(), 1s, supervise{epoch, revivals, {entry}});
    world.run_until_idle();
    EXPECT_EQ(asked->answers, 1);
    return asked->answer.epoch;
  }
  table_epoch want(const std::string& name, bool wanted) { return set({1, ++tables}, {name, wanted, with(100)}); }
  [[nodiscard]] health_entry health_of(const std::string& name) const { return guardian_test::health_of(world, name); }

  simulated_disk disk;
  std::map<std::string, int> counted;
  boss_notes notes;
  std::uint64_t tables = 0;
  simulation world;
  std::map<std::string, worker_handle> workers;
};

using list = std::vector<std::string>;

class listener final : public actor_base<liveness_handle> {
public:
  listener(spawn_context context, list* heard) : actor_base(std::move(context)), heard_(heard) {}

protected:
  behavior_type handlers() override {
    return {on<child_alive>([this](const child_alive& each) { heard_->push_back(each.name); })};
  }

private:
  list* heard_;
};

TEST(guardian, starts_children_in_the_order_of_their_declaration) {
  world_of_workers w;
  w.start();
  EXPECT_EQ(w.events(), (list{"first up 1", "second up 1", "third up 1"}));
  EXPECT_EQ(w.health_of("first").colour, health_colour::green);
}

TEST(guardian, tells_who_has_asked_that_a_child_has_begun_and_answers_its_pings) {
  world_of_workers w;
  list heard;
  w.world.actors().tell_who_lives(w.world.actors().add<listener>({.name = "listener"}, with(100), &heard), {"second"});
  w.start();
  EXPECT_EQ(heard, list{"second"});
  w.world.advance(3500ms);
  EXPECT_EQ(heard, list(4, "second")) << "one for each ping";
  heard.clear();
  w.crash("second");
  EXPECT_EQ(heard, list{"second"}) << "begun again";
}

TEST(guardian, a_child_that_hangs_is_not_said_to_live) {
  world_of_workers w;
  list heard;
  w.world.actors().tell_who_lives(w.world.actors().add<listener>({.name = "listener"}, with(100), &heard), {"second"});
  w.start();
  w.world.hang("second");
  w.world.advance(5s);
  EXPECT_EQ(heard, list{"second"});
}

TEST(guardian, stops_children_in_reverse_order) {
  world_of_workers w;
  w.start();
  const auto before = w.events().size();
  EXPECT_TRUE(w.world.stop());
  EXPECT_EQ(w.events_after(before), (list{"third stopped 1", "second stopped 1", "first stopped 1"}));
}

TEST(guardian, a_crashed_child_comes_back_at_once_then_after_doubling_waits) {
  world_of_workers w;
  w.start();
  std::uint64_t incarnation = 1;
  for (const auto wait : {0ms, 100ms, 200ms, 400ms, 800ms}) {
    EXPECT_TRUE(w.world.kill("second"));
    w.world.run_until_idle();
    if (wait > 0ms) {
      w.world.advance(wait - 10ms); // timers see time in strides of 10 ms
      EXPECT_EQ(w.report("second").phase, child_phase::waiting) << wait.count();
      w.world.advance(10ms);
    }
    EXPECT_EQ(w.report("second").phase, child_phase::running) << wait.count();
    EXPECT_EQ(w.report("second").incarnation, ++incarnation);
  }
  EXPECT_EQ(w.report("second").restarts, 5U);
  EXPECT_EQ(w.report("first").incarnation, 1U);
}

TEST(guardian, rest_for_one_stops_the_later_children_and_starts_all_again_in_order) {
  world_of_workers w(with(100), strategy::rest_for_one);
  w.start();
  const auto before = w.events().size();
  EXPECT_TRUE(w.world.kill("first"));
  w.world.run_until_idle();
  EXPECT_EQ(w.events_after(before), (list{"first crashed 1", "third stopped 1", "second stopped 1", "first up 2",
                                          "second up 2", "third up 2"}));
}

TEST(guardian, rest_for_one_keeps_the_mail_of_those_that_it_stops) {
  world_of_workers w(with(100), strategy::rest_for_one);
  w.start();
  EXPECT_TRUE(w.world.kill("first"));
  for (int i = 0; i < 10; ++i)
    w.world.tell(w.workers.at("third"), count_up{});
  w.world.advance(1s);
  EXPECT_EQ(w.report("third").incarnation, 2U);
  EXPECT_EQ(w.counted["third"], 10);
}

TEST(guardian, an_essential_child_that_is_given_up_asks_for_the_exit) {
  world_of_workers w(with(0, true));
  w.start();
  EXPECT_FALSE(w.world.exit());
  w.crash("second");
  ASSERT_TRUE(w.world.exit());
  EXPECT_EQ(w.world.exit()->cause, exit_cause::essential_given_up);
  EXPECT_EQ(w.world.exit()->reason, "second is essential and was given up: told to fail");
}

TEST(guardian, a_child_given_up_that_is_not_essential_leaves_the_rest_and_a_red_health_with_the_reason) {
  world_of_workers w(with(0));
  w.start();
  w.crash("second");
  EXPECT_FALSE(w.world.exit());
  EXPECT_EQ(w.health_of("second").colour, health_colour::red);
  EXPECT_EQ(w.health_of("second").reason, "given up: told to fail");
  EXPECT_EQ(w.report("second").phase, child_phase::given_up);
  w.world.tell(w.workers.at("third"), count_up{});
  w.world.run_until_idle();
  EXPECT_EQ(w.counted["third"], 1);
  EXPECT_TRUE(w.world.stop());
}

TEST(guardian, a_child_that_is_not_wanted_is_stopped_and_started_again_when_it_is) {
  world_of_workers w;
  w.start();
  w.want("second", false);
  EXPECT_EQ(w.report("second").phase, child_phase::absent);
  EXPECT_FALSE(w.report("second").wanted);
  w.world.advance(1min);
  EXPECT_EQ(w.report("second").phase, child_phase::absent);
  w.want("second", true);
  EXPECT_EQ(w.report("second").phase, child_phase::running);
  EXPECT_EQ(w.world.counters("second").crashes, 0U);
}

TEST(guardian, a_child_that_hangs_while_it_stops_does_not_delay_the_restart_of_another) {
  world_of_workers w;
  w.start();
  auto& jobs = dynamic_cast<caf::scheduler::test_coordinator&>(w.world.actors().actors().scheduler()).jobs;
  const auto run_all_but_the_first = [&] {
    while (jobs.size() > 1)
      ASSERT_TRUE(w.world.step(1));
  };
  (void)w.world.ask(w.world.actors().guardian(), 1s, supervise{{1, 1}, 0, {{"first", false, with(100)}}});
  ASSERT_TRUE(w.world.step(0)); // the guardian tells it to stop, and it gets no worker
  run_all_but_the_first();
  EXPECT_TRUE(w.world.kill("second"));
  w.world.tell(w.workers.at("second"), count_up{});
  run_all_but_the_first();
  const auto events = w.events();
  EXPECT_EQ(events.back(), "second up 2");
  EXPECT_EQ(std::ranges::count(events, "first stopped 1"), 0);
  EXPECT_EQ(w.counted["second"], 1);
  w.world.run_until_idle();
  EXPECT_EQ(w.events().back(), "first stopped 1");
}

TEST(guardian, tells_to_a_child_that_is_not_wanted_are_dropped_and_counted) {
  world_of_workers w;
  w.start();
  w.want("second", false);
  for (int i = 0; i < 3; ++i)
    w.world.tell(w.workers.at("second"), count_up{});
  w.want("second", true);
  EXPECT_EQ(w.counted["second"], 0);
  EXPECT_EQ(w.world.counters("second").dropped, 3U);
  w.world.tell(w.workers.at("second"), count_up{});
  w.world.run_until_idle();
  EXPECT_EQ(w.counted["second"], 1);
}

TEST(guardian, what_waited_for_a_child_in_its_back_off_is_dropped_when_it_is_given_up) {
  world_of_workers w(with(2));
  w.start();
  for (int i = 0; i < 2; ++i) { // at once, then after 100 ms
    EXPECT_TRUE(w.world.kill("second"));
    w.world.run_until_idle();
  }
  w.world.tell(w.workers.at("second"), count_up{});
  EXPECT_EQ(w.world.counters("second").dropped, 0U) << "it comes back";
  w.want("second", false);
  EXPECT_EQ(w.world.counters("second").dropped, 1U);
}

TEST(guardian, an_ask_to_a_child_that_was_given_up_is_refused_at_once) {
  simulated_disk disk;
  godwit::tests::audit seen;
  simulation world(disk, 1);
  const auto auditor = world.actors().add<godwit::tests::auditor_actor>({.name = "auditor"}, with(100), &seen);
  const auto ledger = world.actors().add<godwit::tests::ledger_actor>({.name = "ledger"}, with(0), auditor);
  world.start();
  world.run_until_idle();
  EXPECT_TRUE(world.kill("ledger"));
  world.run_until_idle();
  const auto asked = world.ask(ledger, 1h, godwit::tests::withdraw{1, 1});
  world.run_until_idle();
  EXPECT_EQ(asked->failures, 1);
  EXPECT_EQ(world.counters("ledger").refused, 1U);
}

TEST(guardian, a_child_given_up_stays_so_when_it_is_wanted_and_runs_and_is_green_when_it_is_revived) {
  world_of_workers w(with(0));
  w.start();
  w.set({1, 1}, {"first", true, with(0)});
  EXPECT_TRUE(w.world.kill("first"));
  w.world.run_until_idle();
  EXPECT_EQ(w.health_of("first").colour, health_colour::red);
  w.set({1, 2}, {"first", true, with(0)});
  EXPECT_EQ(w.report("first").phase, child_phase::given_up);
  w.set({1, 3}, {"first", true, with(0)}, 1);
  EXPECT_EQ(w.report("first").phase, child_phase::running);
  EXPECT_EQ(w.health_of("first").colour, health_colour::green);
}

TEST(guardian, the_first_table_of_a_process_revives_nobody) {
  world_of_workers w(with(0));
  w.start();
  EXPECT_TRUE(w.world.kill("first"));
  w.world.run_until_idle();
  w.set({1, 1}, {"second", true, with(0)}, 7);
  EXPECT_EQ(w.report("first").phase, child_phase::given_up);
}

TEST(guardian, a_table_with_an_older_epoch_is_ignored_and_answered_with_the_one_that_holds) {
  world_of_workers w;
  w.start();
  EXPECT_EQ(w.set({2, 1}, {"second", true, with(100)}), (table_epoch{2, 1}));
  EXPECT_EQ(w.set({1, 9}, {"second", false, with(100)}), (table_epoch{2, 1})) << "of an incarnation before";
  EXPECT_EQ(w.set({2, 1}, {"second", false, with(100)}), (table_epoch{2, 1})) << "the same, once more";
  EXPECT_EQ(w.report("second").phase, child_phase::running);
}

TEST(guardian, a_table_that_says_the_same_keeps_crash_histories_and_waits) {
  world_of_workers w(with(2));
  w.start();
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(w.world.kill("second"));
    w.world.run_until_idle();
    w.set({1, ++w.tables}, {"second", true, with(2)});
  }
  EXPECT_EQ(w.report("second").phase, child_phase::waiting);
  w.world.advance(100ms);
  EXPECT_TRUE(w.world.kill("second"));
  w.world.run_until_idle();
  EXPECT_EQ(w.report("second").phase, child_phase::given_up) << "its third crash";
}

TEST(guardian, a_child_of_the_floor_can_not_be_unwanted) {
  world_of_workers w;
  w.world.actors().set_floor({"second"});
  w.start();
  w.want("second", false);
  w.want("third", false);
  EXPECT_EQ(w.report("second").phase, child_phase::running);
  EXPECT_EQ(w.report("third").phase, child_phase::absent);
}

TEST(guardian, a_child_that_the_first_table_goes_without_starts_when_a_later_one_wants_it) {
  world_of_workers w;
  w.world.actors().begin_with({{"second", false, with(100)}});
  w.start();
  EXPECT_EQ(w.report("second").phase, child_phase::absent);
  EXPECT_EQ(w.report("third").phase, child_phase::running);
  EXPECT_TRUE(w.world.actors().has_begun());
  w.want("second", true);
  EXPECT_EQ(w.report("second").phase, child_phase::running);
}

// What happens when `second`, essential, crashes once too often while the table says that a vehicle flies.
std::optional<exit_request> given_up_in_flight(world_of_workers& w, bool may_end_fast) {
  w.world.actors().let_end_fast(may_end_fast);
  w.start();
  auto policy = with(0, true);
  policy.end = process_end::fast_once;
  w.set({1, 1}, {"second", true, policy});
  EXPECT_TRUE(w.world.kill("second"));
  w.world.run_until_idle();
  return w.world.exit();
}

TEST(guardian, an_essential_child_that_is_given_up_in_flight_asks_for_a_fast_end) {
  world_of_workers w;
  const auto why = given_up_in_flight(w, true);
  ASSERT_TRUE(why);
  EXPECT_EQ(why->cause, exit_cause::given_up_in_flight);
  EXPECT_EQ(why->reason, "second is essential and was given up: killed");
}

TEST(guardian, an_essential_child_that_is_given_up_in_flight_again_ends_nothing) {
  world_of_workers w;
  EXPECT_FALSE(given_up_in_flight(w, false));
  EXPECT_EQ(w.report("second").phase, child_phase::given_up);
  EXPECT_EQ(w.report("first").phase, child_phase::running);
  EXPECT_EQ(w.report("third").phase, child_phase::running);
}

TEST(guardian, a_recovery_that_takes_more_than_ten_seconds_ends_the_process) {
  simulated_disk disk;
  godwit::tests::audit seen;
  simulation world(disk, 1);
  const auto auditor = world.actors().add<godwit::tests::auditor_actor>({.name = "auditor"}, with(100), &seen);
  (void)world.actors().add<godwit::tests::ledger_actor>({.name = "ledger"}, with(100), auditor);
  world.start();
  auto& scheduler = dynamic_cast<caf::scheduler::test_coordinator&>(world.actors().actors().scheduler());
  const auto pass = [&](milliseconds duration) { // the journal does nothing
    for (; duration > 0ms; duration -= 250ms) {
      scheduler.advance_time(250ms);
      while (scheduler.try_run_once()) {
      }
    }
  };
  pass(10s);
  EXPECT_FALSE(world.exit());
  pass(500ms);
  ASSERT_TRUE(world.exit());
  EXPECT_EQ(world.exit()->cause, exit_cause::recovery_overdue);
  EXPECT_EQ(world.exit()->reason, "ledger: the journal has not given its state back for 10000 ms");
}

TEST(guardian, a_name_that_no_child_has_is_posted_to_health) {
  world_of_workers w;
  w.start();
  w.set({1, 1}, {"secnod", true, with(0)});
  EXPECT_EQ(w.health_of("guardian").colour, health_colour::yellow);
  EXPECT_NE(w.health_of("guardian").reason.find("secnod"), std::string::npos);
}

TEST(guardian, reports_of_each_child_whether_it_is_wanted_and_essential_and_how_it_is) {
  world_of_workers w(with(0, true));
  w.start();
  w.want("third", false);
  EXPECT_TRUE(w.world.kill("second"));
  w.world.run_until_idle();
  EXPECT_TRUE(w.report("second").essential);
  EXPECT_TRUE(w.report("second").wanted);
  EXPECT_EQ(w.report("second").health, health_colour::red);
  EXPECT_EQ(w.report("second").health_reason, "given up: killed");
  EXPECT_EQ(w.report("second").last_crash, "killed");
  EXPECT_FALSE(w.report("third").wanted);
  EXPECT_EQ(w.report("third").health, health_colour::green);
}

TEST(guardian, a_constructor_that_throws_is_a_crash) {
  simulated_disk disk;
  simulation world(disk, 1);
  int failures_left = 2;
  (void)world.actors().add<late_bloomer>({.name = "late"}, with(3), &failures_left);
  world.start();
  world.run_until_idle();
  EXPECT_EQ(failures_left, 0) << "the second waits";
  world.advance(100ms);
  EXPECT_EQ(failures_left, -1);
  EXPECT_FALSE(world.exit());
  EXPECT_TRUE(world.stop());
}

TEST(guardian, a_child_whose_durable_state_can_not_be_read_is_given_up_at_once) {
  simulated_disk disk;
  disk.actors["ledger"].kept.snapshot = {1, 0, 99, "{}"}; // of a later version
  disk.actors["ledger"].kept.last_event = 1;
  godwit::tests::audit seen;
  simulation world(disk, 1);
  const auto auditor = world.actors().add<godwit::tests::auditor_actor>({.name = "auditor"}, with(100), &seen);
  (void)world.actors().add<godwit::tests::ledger_actor>({.name = "ledger"}, with(100, true), auditor);
  world.start();
  world.run_until_idle();
  ASSERT_TRUE(world.exit());
  EXPECT_EQ(world.exit()->cause, exit_cause::essential_given_up);
  EXPECT_NE(world.exit()->reason.find("version 99"), std::string::npos) << world.exit()->reason;
  EXPECT_EQ(world.counters("ledger").crashes, 1U);
}

TEST(guardian, stopping_does_not_wait_for_a_recovery_under_way) {
  simulated_disk disk;
  godwit::tests::audit seen;
  simulation world(disk, 1);
  const auto auditor = world.actors().add<godwit::tests::auditor_actor>({.name = "auditor"}, with(100), &seen);
  (void)world.actors().add<godwit::tests::ledger_actor>({.name = "ledger"}, with(100), auditor);
  world.start();
  while (world.journal().waiting() == 0) // the first choice is always an actor, as long as one has mail
    ASSERT_TRUE(world.step(0));
  world.actors().begin_stop();
  EXPECT_TRUE(world.stop());
}

// -- the actor that supervises -----------------------------------------------------------------------

struct world_with_a_boss : world_of_workers {
  explicit world_with_a_boss(child_policy policy = with(100)) : world_of_workers(policy) {
    chief = world.actors().add<boss>({.name = "boss"}, with(100), world.actors().guardian(), &notes);
    world.actors().set_supervisor(chief);
  }
  boss_handle chief;
};

TEST(guardian, the_supervisor_hears_what_happens_to_the_children) {
  world_with_a_boss w(with(1));
  w.start();
  EXPECT_EQ(w.notes.events, (list{"first up 1", "second up 1", "third up 1", "boss up 1"}));
  w.notes.events.clear();
  w.world.tell(w.workers.at("second"), fail{}); // put back, it crashes the next incarnation too
  w.world.run_until_idle();
  EXPECT_EQ(w.notes.events, (list{"second crashed 1", "second up 2", "second crashed 2", "second gave_up 2"}));
}

TEST(guardian, a_new_incarnation_of_the_supervisor_adopts_the_children_as_they_are) {
  world_with_a_boss w;
  w.start();
  EXPECT_TRUE(w.world.kill("second"));
  w.world.run_until_idle();
  ASSERT_EQ(w.notes.adopted.size(), 1U);
  w.world.tell(w.chief, fail{});
  w.world.advance(1s);
  ASSERT_EQ(w.world.counters("boss").crashes, 3U) << "the message is a dead letter by now";
  ASSERT_EQ(w.notes.adopted.size(), 2U) << "those in between did not live to hear the answer";
  const auto& found = w.notes.adopted.back().list;
  ASSERT_EQ(found.size(), 4U);
  const std::uint64_t expected[] = {1, 2, 1};
  for (std::size_t i = 0; i < std::size(expected); ++i) {
    EXPECT_EQ(found[i].phase, child_phase::running) << found[i].name;
    EXPECT_EQ(found[i].incarnation, expected[i]) << found[i].name;
  }
  EXPECT_EQ(found[1].restarts, 1U);
  EXPECT_EQ(found[1].last_crash, "killed");
}

TEST(guardian, what_happens_while_the_supervisor_is_down_is_told_to_its_next_incarnation) {
  world_with_a_boss w;
  w.start();
  for (int i = 0; i < 2; ++i) { // the second crash is followed by a wait
    EXPECT_TRUE(w.world.kill("boss"));
    w.world.run_until_idle();
  }
  w.notes.events.clear();
  EXPECT_TRUE(w.world.kill("first"));
  w.world.run_until_idle();
  EXPECT_EQ(w.report("boss").phase, child_phase::waiting);
  EXPECT_EQ(w.report("first").incarnation, 2U) << "the guardian goes on with the last table";
  w.world.advance(100ms);
  EXPECT_EQ(w.notes.events, (list{"boss crashed 2", "first crashed 1", "first up 2", "boss up 3"}));
}

TEST(guardian, the_last_table_holds_while_the_supervisor_is_down) {
  world_with_a_boss w;
  w.start();
  w.world.tell(w.chief, supervise{{1, 1}, 0, {{"third", true, with(0, true)}}});
  w.world.run_until_idle();
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(w.world.kill("boss"));
    w.world.run_until_idle();
  }
  ASSERT_EQ(w.report("boss").phase, child_phase::waiting);
  EXPECT_FALSE(w.world.exit());
  EXPECT_TRUE(w.world.kill("third"));
  w.world.run_until_idle();
  ASSERT_TRUE(w.world.exit());
  EXPECT_EQ(w.world.exit()->reason, "third is essential and was given up: killed");
}

// -- pings
// -------------------------------------------------------------------------------------------------------------

TEST(guardian, an_actor_that_answers_its_pings_is_left_alone) {
  world_of_workers w;
  w.start();
  const auto before = w.events().size();
  w.world.advance(2min);
  EXPECT_EQ(w.events_after(before), list{});
  EXPECT_EQ(w.health_of("first").colour, health_colour::green);
  EXPECT_EQ(w.world.counters("first").accepted, 0U) << "pings are nobody's mail";
  EXPECT_EQ(w.world.counters("first").handled, 0U);
}

// Time passes, and everybody gets a worker but the actor whose job waits longest.
void advance_without_the_first(simulation& world, nanoseconds duration) {
  auto& scheduler = dynamic_cast<caf::scheduler::test_coordinator&>(world.actors().actors().scheduler());
  for (; duration > 0ns; duration -= 250ms) {
    scheduler.advance_time(250ms);
    while (scheduler.jobs.size() > 1)
      ASSERT_TRUE(world.step(1));
  }
}

TEST(guardian, an_actor_that_does_not_answer_is_warned_of_then_replaced_and_loses_no_mail) {
  simulated_disk disk;
  simulation world(disk, 1);
  int counted = 0;
  const auto starved = world.actors().add<worker>({.name = "starved"}, with(100), &counted);
  world.start();
  world.run_until_idle();
  for (int i = 0; i < 3; ++i)
    world.tell(starved, count_up{});
  const auto colour = [&] { return health_of(world, "starved").colour; };
  advance_without_the_first(world, 3s);
  EXPECT_EQ(colour(), health_colour::green);
  advance_without_the_first(world, 1s + 250ms); // the ping went out after one second
  EXPECT_EQ(colour(), health_colour::yellow);
  advance_without_the_first(world, 7s);
  EXPECT_EQ(colour(), health_colour::green) << "the successor is up";
  EXPECT_EQ(world.counters("starved").crashes, 1U);
  EXPECT_EQ(counted, 0);
  world.run_until_idle(); // the first incarnation has its turn after all
  EXPECT_EQ(counted, 3) << "by the successor";
  EXPECT_EQ(world.counters("starved").handled, 3U);
  EXPECT_EQ(world.counters("starved").lost, 0U);
  EXPECT_TRUE(world.stop());
}

TEST(guardian, an_actor_with_a_full_mailbox_still_gets_its_pings) {
  simulated_disk disk;
  simulation world(disk, 1);
  int counted = 0;
  const auto busy = world.actors().add<worker>({.name = "busy", .mailbox_bound = 3}, with(0, true), &counted);
  world.start();
  world.run_until_idle();
  constexpr int rounds = 120;
  for (int round = 0; round < rounds; ++round) {
    for (int i = 0; i < 5; ++i)
      world.tell(busy, count_up{}); // three fit
    advance_without_the_first(world, 250ms);
    world.run_until_idle();
  }
  EXPECT_EQ(counted, 3 * rounds);
  EXPECT_EQ(world.counters("busy").refused, 2U * rounds);
  EXPECT_FALSE(world.exit());
}

} // namespace guardian_test
