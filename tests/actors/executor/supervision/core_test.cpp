#include "actors/executor/supervision/core.hpp"

#include <gtest/gtest.h>

namespace core_test {

using namespace godwit::executor;
using namespace godwit::executor::supervision;
using godwit::runtime::child_event_kind;
using godwit::runtime::child_phase;
using godwit::runtime::children;
using supervisor = godwit::executor::supervision::core;

constexpr std::int64_t second = 1'000'000'000;
const std::vector<std::string> names{"vehicle_link", "failsafe", "mission_client", "executor"};

struct world {
  supervision::state durable;
  bool in_flight = false;
  bool has_scans = false;
  std::int64_t now_ns = 0;
  supervisor core{{}, 1, names};

  void look() { core.look(durable, in_flight, has_scans, now_ns); }
  void wait(std::int64_t duration_ns) {
    look();
    now_ns += duration_ns;
    look();
  }
  void change(bool flies) {
    in_flight = flies;
    change_in_flight(durable, flies);
    look();
  }
  void acknowledge() {
    ASSERT_TRUE(core.unacknowledged());
    core.on_acknowledged(core.unacknowledged()->epoch);
  }
  std::vector<announce> hear(const std::string& name, child_event_kind kind, std::uint64_t incarnation = 1,
                             const std::string& reason = {}) {
    return core.on_event({name, kind, incarnation, reason}, now_ns);
  }
  bool is_running(const std::string& name) const {
    for (const auto& each : core.facts())
      if (each.name == name)
        return each.is_running;
    ADD_FAILURE() << name;
    return false;
  }
};

children all_running() {
  children result;
  for (const auto& each : names) {
    godwit::runtime::child_report report;
    report.name = each;
    report.phase = child_phase::running;
    result.list.push_back(report);
  }
  return result;
}

TEST(supervision, a_new_incarnation_sends_the_table_of_its_durable_state_at_once) {
  world w;
  w.durable.landings = 3;
  w.in_flight = true;
  w.core = supervisor({}, 7, names);
  w.look();
  const auto table = w.core.unacknowledged();
  ASSERT_TRUE(table);
  EXPECT_EQ(w.core.now(), part::flight);
  EXPECT_EQ(table->epoch, (godwit::runtime::table_epoch{7, 1}));
  EXPECT_EQ(table->revivals, 3U);
  EXPECT_EQ(table->list.size(), names.size());
}

TEST(supervision, a_table_is_sent_until_it_is_acknowledged) {
  world w;
  w.look();
  const auto first = w.core.unacknowledged();
  w.now_ns += second;
  w.look();
  ASSERT_TRUE(w.core.unacknowledged());
  EXPECT_EQ(w.core.unacknowledged()->epoch, first->epoch);
  w.core.on_acknowledged({0, 9});
  EXPECT_TRUE(w.core.unacknowledged()) << "that was an older one";
  w.acknowledge();
  EXPECT_FALSE(w.core.unacknowledged());
}

TEST(supervision, a_part_counts_when_it_has_held_for_five_seconds) {
  world w;
  w.look();
  w.acknowledge();
  w.change(true);
  w.wait(part_holds_ns - 1);
  EXPECT_EQ(w.core.now(), part::ground);
  EXPECT_FALSE(w.core.unacknowledged());
  w.wait(1);
  EXPECT_EQ(w.core.now(), part::flight);
  EXPECT_EQ(w.core.unacknowledged()->epoch.n, 2U);
}

TEST(supervision, a_landing_that_the_next_take_off_follows_at_once_changes_no_table) {
  world w;
  w.in_flight = true;
  w.look();
  w.acknowledge();
  w.change(false);
  w.wait(3 * second);
  w.change(true);
  w.wait(20 * second);
  EXPECT_EQ(w.core.now(), part::flight);
  EXPECT_FALSE(w.core.unacknowledged());
}

TEST(supervision, what_was_given_up_is_revived_once_for_each_landing) {
  world w;
  w.look();
  EXPECT_EQ(w.core.unacknowledged()->revivals, 0U);
  for (std::uint64_t n = 1; n <= 2; ++n) {
    w.change(true);
    w.wait(part_holds_ns);
    EXPECT_EQ(w.core.unacknowledged()->revivals, n - 1) << "not in flight";
    w.change(false);
    w.wait(part_holds_ns);
    EXPECT_EQ(w.core.unacknowledged()->revivals, n);
  }
}

TEST(supervision, nobody_is_known_to_run_before_the_guardian_has_said_so) {
  world w;
  EXPECT_FALSE(w.is_running("failsafe"));
  EXPECT_FALSE(w.core.knows_children());
  EXPECT_TRUE(w.core.on_children(all_running(), 0).empty());
  EXPECT_TRUE(w.is_running("failsafe"));
  EXPECT_TRUE(w.core.knows_children());
}

TEST(supervision, the_preflight_check_hears_of_each_crash_and_of_who_is_back) {
  world w;
  (void)w.core.on_children(all_running(), 0);
  for (const auto kind :
       {child_event_kind::crashed, child_event_kind::silent, child_event_kind::gave_up, child_event_kind::stopped}) {
    (void)w.hear("failsafe", kind);
    EXPECT_FALSE(w.is_running("failsafe")) << static_cast<int>(kind);
    (void)w.hear("failsafe", child_event_kind::up, 2);
    EXPECT_TRUE(w.is_running("failsafe"));
  }
  (void)w.hear("failsafe", child_event_kind::late);
  EXPECT_TRUE(w.is_running("failsafe")) << "it may still answer";
}

TEST(supervision, who_only_shows_is_supervised_and_no_matter_of_preflight) {
  supervisor core{{}, 1, {"executor", "health", "telemetry_stream"}};
  core.look({}, false, false, 0);
  ASSERT_TRUE(core.unacknowledged());
  EXPECT_EQ(core.unacknowledged()->list.size(), 3U);
  const auto facts = core.facts();
  ASSERT_EQ(facts.size(), 1U);
  EXPECT_EQ(facts.front().name, "executor");
}

TEST(supervision, people_are_told_of_a_crash_of_who_is_back_and_warned_of_who_is_given_up) {
  world w;
  EXPECT_TRUE(w.hear("mission_client", child_event_kind::up, 1).empty()) << "its first start";
  const auto crash = w.hear("mission_client", child_event_kind::crashed, 1, "killed");
  ASSERT_EQ(crash.size(), 1U);
  EXPECT_EQ(crash[0].sentence, "mission_client crashed: killed");
  EXPECT_FALSE(crash[0].is_warning);
  const auto back = w.hear("mission_client", child_event_kind::up, 2);
  ASSERT_EQ(back.size(), 1U);
  EXPECT_EQ(back[0].sentence, "mission_client is back");
  const auto end = w.hear("mission_client", child_event_kind::gave_up, 2, "killed");
  ASSERT_EQ(end.size(), 1U);
  EXPECT_EQ(end[0].sentence, "mission_client is given up: killed");
  EXPECT_TRUE(end[0].is_warning);
}

TEST(supervision, who_was_given_up_before_this_incarnation_is_told_once) {
  world w;
  auto found = all_running();
  found.list[2].phase = child_phase::given_up;
  found.list[2].last_crash = "killed";
  EXPECT_EQ(w.core.on_children(found, 0).size(), 1U);
  EXPECT_TRUE(w.core.on_children(found, 1).empty());
  EXPECT_FALSE(w.is_running("mission_client"));
}

TEST(supervision, who_comes_back_from_being_away_is_told_once_what_it_has_missed) {
  world w;
  (void)w.core.on_children(all_running(), 0);
  (void)w.hear("mission_client", child_event_kind::crashed);
  (void)w.hear("mission_client", child_event_kind::up, 2);
  EXPECT_TRUE(w.core.take_returned().empty()) << "its mail waited for it";
  for (const auto kind : {child_event_kind::gave_up, child_event_kind::stopped}) {
    (void)w.hear("mission_client", kind, 2);
    (void)w.hear("mission_client", child_event_kind::up, 3);
    EXPECT_EQ(w.core.take_returned(), std::vector<std::string>{"mission_client"});
    EXPECT_TRUE(w.core.take_returned().empty());
  }
}

TEST(supervision, who_was_not_wanted_when_this_incarnation_began_comes_back_as_well) {
  world w;
  auto found = all_running();
  found.list[2].phase = child_phase::absent;
  found.list[2].wanted = false;
  (void)w.core.on_children(found, 0);
  (void)w.hear("mission_client", child_event_kind::up, 1);
  EXPECT_EQ(w.core.take_returned(), std::vector<std::string>{"mission_client"});
}

TEST(supervision, a_mission_with_scanning_in_flight_is_another_table_and_on_the_ground_it_is_none) {
  world w;
  w.look();
  w.acknowledge();
  w.has_scans = true;
  w.wait(20 * second);
  EXPECT_FALSE(w.core.unacknowledged());
  EXPECT_FALSE(w.core.is_scanning());
  w.change(true);
  w.wait(part_holds_ns);
  EXPECT_TRUE(w.core.is_scanning());
  w.acknowledge();
  w.has_scans = false; // the rest of the mission was replaced
  w.look();
  EXPECT_TRUE(w.core.unacknowledged());
  EXPECT_FALSE(w.core.is_scanning());
}

TEST(supervision, who_is_not_wanted_on_the_ground_is_none_of_the_preflight_checks_and_coming_is_no_news) {
  world w;
  w.core = supervisor({}, 1, {"executor", "scan_controller"});
  ASSERT_EQ(w.core.facts().size(), 1U);
  EXPECT_EQ(w.core.facts()[0].name, "executor");
  (void)w.hear("scan_controller", child_event_kind::stopped, 1);
  EXPECT_TRUE(w.hear("scan_controller", child_event_kind::up, 2).empty()) << "the next flight";
}

struct without_failsafe : testing::Test {
  world w;
  void SetUp() override {
    w.in_flight = true;
    w.look();
    (void)w.core.on_children(all_running(), 0);
  }
  bool misses() const { return w.core.misses_failsafe(w.durable, w.now_ns); }
};

TEST_F(without_failsafe, it_is_missed_when_the_process_has_gone_on_without_it) {
  EXPECT_FALSE(misses());
  (void)w.hear("failsafe", child_event_kind::gave_up, 6);
  w.now_ns += second / 2;
  EXPECT_FALSE(misses()) << "the process may still end because of it";
  w.now_ns += second / 2;
  EXPECT_TRUE(misses());
}

TEST_F(without_failsafe, it_is_decided_about_once_a_flight) {
  (void)w.hear("failsafe", child_event_kind::gave_up, 6);
  w.now_ns += second;
  apply(w.durable, failsafe_missed{});
  EXPECT_FALSE(misses());
  EXPECT_TRUE(w.core.is_failsafe_gone(w.now_ns)) << "no plan is changed as long as it is gone";
}

TEST_F(without_failsafe, a_crash_that_it_comes_back_from_is_none) {
  (void)w.hear("failsafe", child_event_kind::crashed, 1);
  w.now_ns += second;
  EXPECT_FALSE(misses());
}

TEST_F(without_failsafe, it_is_not_missed_once_it_is_back) {
  (void)w.hear("failsafe", child_event_kind::gave_up, 6);
  (void)w.hear("failsafe", child_event_kind::up, 7);
  w.now_ns += second;
  EXPECT_FALSE(misses());
}

TEST_F(without_failsafe, on_the_ground_nothing_is_brought_home) {
  w.change(false);
  w.wait(part_holds_ns);
  (void)w.hear("failsafe", child_event_kind::gave_up, 6);
  w.now_ns += second;
  EXPECT_FALSE(misses());
}

} // namespace core_test
