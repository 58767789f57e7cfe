// Changes that the vehicle flies already, because the service did not answer: it gets them as soon as it is back,
// before all that names their items and their revision, and nothing is lost or doubled by that, whatever it answers.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <optional>

#include "tests/actors/mission_client/client_world.hpp"

namespace flown_change_test {

using namespace godwit;
using namespace godwit::mission_client;
using namespace godwit::mission_client::test;
using namespace std::chrono_literals;
using runtime::crash_point;

template <class Change>
Change flown(Change what) {
  what.is_flown = true;
  return what;
}

// Of an item of the revision that the vehicle has numbered.
report_progress report_of(std::uint32_t number, const std::string& item, std::int32_t revision = 2) {
  auto result = report(mission_a, number);
  result.report.item_id = item;
  result.report.revision = revision;
  result.report.generation = 2;
  return result;
}

std::vector<std::string> items_told(const service_mission& m) {
  std::vector<std::string> result;
  for (const auto& each : m.reports)
    result.push_back(std::to_string(each.report_no) + " " + each.item_id.value_or(""));
  return result;
}

struct away_service {
  explicit away_service(planned_fault how = {.what = fault::no_connection})
      : m(around.service.add(sample_mission(mission_a))) {
    p = std::make_unique<process>(around);
    begin(*p, mission_a);
    around.service.faults.push_back(how);
  }
  void come_back() { around.service.faults.clear(); }
  [[nodiscard]] const heard& told() const { return around.listener; }

  outside around;
  service_mission& m;
  std::unique_ptr<process> p;
};

TEST(mission_client_flown_change, is_at_the_service_within_five_seconds_of_its_return) {
  for (const auto how : {fault::no_connection, fault::silence})
    for (int tenths = 0; tenths < 60; ++tenths) {
      away_service w({.what = how});
      w.p->say(flown(tail(mission_a, 1, 1)));
      w.p->advance(60s + std::chrono::milliseconds(100 * tenths));
      ASSERT_EQ(w.m.changes, 0);
      w.come_back();
      w.p->advance(5s);
      ASSERT_EQ(w.m.changes, 1) << tenths;
      ASSERT_EQ(w.told().outcomes.back().verdict, change_verdict::done);
    }
}

TEST(mission_client_flown_change, is_never_given_up_and_the_pause_that_a_service_asks_for_is_kept) {
  away_service w({.what = fault::status_answer, .status = 503, .retry_after_ns = 90 * second_ns});
  w.p->say(flown(insert(mission_a, 1, 1)));
  w.p->advance(85s);
  EXPECT_EQ(w.around.service.posts("/waypoints"), 1);
  w.p->advance(26h, 1s);
  EXPECT_TRUE(w.told().outcomes.empty());
  w.come_back();
  w.p->advance(91s);
  EXPECT_EQ(w.m.changes, 1);
}

TEST(mission_client_flown_change, goes_out_before_all_reports_that_came_after_it) {
  away_service w({.where = "/tail", .what = fault::no_connection});
  w.p->say(report(mission_a, 1));
  w.p->say(flown(tail(mission_a, 1, 1)));
  w.p->say(report_of(2, "home-1"));
  w.p->say(report_of(3, "w1"));
  w.p->advance(30s);
  EXPECT_EQ(items_told(w.m), std::vector<std::string>{"1 w1"}) << "earlier ones do not wait for it";
  w.come_back();
  w.p->advance(5s);
  EXPECT_EQ(items_told(w.m), (std::vector<std::string>{"1 w1", "2 home-1", "3 w1"}));
  EXPECT_EQ(w.around.service.unknown_items, 0);
}

TEST(mission_client_flown_change, that_was_waited_for_before_takes_effect_once) {
  for (const auto first : {fault::no_connection, fault::lost_answer, fault::silence})
    for (const auto after : {10ms, 1'000ms, 1'990ms, 2'500ms}) {
      away_service w({.what = first});
      w.p->say(tail(mission_a, 1, 1));
      w.p->advance(after);
      w.p->say(flown(tail(mission_a, 1, 1)));
      w.p->advance(10s);
      w.come_back();
      w.p->advance(5s);
      EXPECT_EQ(w.m.changes, 1);
      EXPECT_EQ(w.m.document.revision, 2);
      EXPECT_EQ(w.told().outcomes.back().verdict, change_verdict::done);
      EXPECT_EQ(w.around.service.other_bodies, 0);
    }
}

TEST(mission_client_flown_change, that_the_service_has_as_it_is_flown_is_not_loaded_again) {
  away_service w;
  w.p->say(flown(tail(mission_a, 1, 1)));
  w.come_back();
  w.p->advance(5s);
  EXPECT_EQ(w.told().loaded.size(), 1U) << "at the begin";
  ASSERT_EQ(w.told().outcomes.size(), 1U);
  EXPECT_EQ(w.told().outcomes[0].verdict, change_verdict::done);
}

TEST(mission_client_flown_change, of_which_the_service_makes_another_revision_is_flown_as_the_service_has_it) {
  away_service w;
  w.p->say(flown(tail(mission_a, 2, 1))); // numbered 3 on board
  w.p->say(flown(tail(mission_a, 3, 2)));
  w.m.document.revision = 2;
  w.m.document.items.pop_back(); // makes no difference to the tail
  w.around.service.numbers_by = 4;
  w.come_back();
  w.p->advance(5s);
  ASSERT_EQ(w.told().outcomes.size(), 2U);
  EXPECT_EQ(w.told().outcomes[0].verdict, change_verdict::stale);
  EXPECT_EQ(w.told().outcomes[1].verdict, change_verdict::stale) << "it was made to the one before";
  ASSERT_GE(w.told().loaded.size(), 2U);
  EXPECT_EQ(w.told().loaded.back().document.revision, 6);
  EXPECT_EQ(w.m.changes, 1);
}

// The service has got another revision meanwhile.
TEST(mission_client_flown_change, that_comes_too_late_loses_the_reports_of_its_items_and_no_other_and_leaves_no_gap) {
  away_service w;
  w.p->say(report(mission_a, 1));
  w.p->say(flown(tail(mission_a, 1, 1)));
  w.p->say(report_of(2, "w1"));
  w.p->say(report_of(3, "home-1"));
  w.p->say(report_of(4, "w2"));
  w.p->advance(3s);
  w.m.document.revision = 2;
  w.come_back();
  w.p->advance(10s);
  w.p->say(report_of(5, "home-1"));
  w.p->say(report_of(6, "w3"));
  w.p->advance(5s);
  EXPECT_EQ(items_told(w.m), (std::vector<std::string>{"1 w1", "2 w1", "3 w2", "4 w3"}));
  EXPECT_EQ(w.around.service.unknown_items, 0);
  EXPECT_EQ(w.p->status().orphaned, 0U);
  ASSERT_EQ(w.told().outcomes.size(), 1U);
  EXPECT_EQ(w.told().outcomes[0].verdict, change_verdict::stale);
  ASSERT_EQ(w.told().loaded.size(), 2U);
  EXPECT_EQ(w.told().loaded[1].document.revision, 2) << "though one of this number is flown";
}

TEST(mission_client_flown_change, that_the_service_will_never_have_holds_up_nothing) {
  away_service w({.where = "/waypoints", .what = fault::status_answer, .status = 422});
  w.p->say(flown(insert(mission_a, 1, 1)));
  w.p->say(report_of(1, "look-1"));
  w.p->say(report_of(2, "w2"));
  w.p->advance(5s);
  EXPECT_EQ(items_told(w.m), std::vector<std::string>{"1 w2"});
  ASSERT_EQ(w.told().outcomes.size(), 1U);
  EXPECT_EQ(w.told().outcomes[0].verdict, change_verdict::refused);
  EXPECT_EQ(w.around.service.unknown_items, 0);
}

TEST(mission_client_flown_change, takes_what_was_built_on_it_along_when_it_fails) {
  away_service w;
  w.p->say(flown(insert(mission_a, 1, 1)));
  w.p->say(flown(insert(mission_a, 2, 2)));
  w.p->say(report_of(1, "look-1"));
  w.p->say(report_of(2, "look-2", 3));
  w.p->say(report_of(3, "w2", 3));
  w.p->advance(3s);
  w.m.document.revision = 2; // the second one would fit to it
  w.come_back();
  w.p->advance(10s);
  EXPECT_EQ(w.m.changes, 0);
  EXPECT_EQ(w.told().outcomes.size(), 2U);
  EXPECT_EQ(items_told(w.m), std::vector<std::string>{"1 w2"});
  EXPECT_EQ(w.around.service.unknown_items, 0);
}

TEST(mission_client_flown_change, goes_out_after_the_response_that_made_its_base) {
  away_service w({.where = "/response", .what = fault::no_connection});
  const auto wanted = sample_assignment(w.m.document, 1);
  w.around.service.assign(mission_a, wanted);
  w.p->advance(2s);
  w.p->say(response(mission_a, wanted, mission::assignment_outcome::accepted, 1));
  w.p->say(flown(insert(mission_a, 2, 1)));
  w.p->advance(10s);
  EXPECT_EQ(w.around.service.posts("/waypoints"), 0);
  w.come_back();
  w.p->advance(10s);
  EXPECT_EQ(w.m.responses.size(), 1U);
  EXPECT_EQ(w.m.changes, 1) << "its base is at the service";
}

TEST(mission_client_flown_change, for_which_there_is_no_room_is_reported_and_its_items_are_left_out) {
  state s;
  s.mission_id = mission_a;
  s.rows.resize(max_outbox_rows + outbox_reserve);
  for (std::size_t i = 0; i < s.rows.size(); ++i)
    s.rows[i].key = std::to_string(i);
  const auto effects = durable_core::apply(s, flown(insert(mission_a, 1, 1)), 10);
  ASSERT_EQ(effects.size(), 1U);
  EXPECT_EQ(std::get<change_outcome>(effects[0]).verdict, change_verdict::refused);
  EXPECT_EQ(find_note(s, mission_a)->left_out, std::vector<std::string>{"look-1"});
}

// -- crashes and kills --------------------------------------------------------------------------------

struct injection {
  std::size_t after = 0;            // messages of mission_client
  std::optional<crash_point> where; // none: the whole process is killed
};

// One who asks, flies without an answer, reports, changes once more and reports; the service comes back at some time.
// All is said again to a new process, as one with durable effects does.
class unanswered_flight {
public:
  unanswered_flight(injection what, bool is_stale) : is_stale_(is_stale), what_(what) {
    around.service.add(sample_mission(mission_a));
    begin_process();
  }
  void fly() {
    using step = std::function<void(process&)>;
    const std::array<step, 9> steps{[](process& p) { p.say(begin_mission{mission_a}); },
                                    [](process& p) { p.say(report(mission_a, 1)); },
                                    [](process& p) { p.say(insert(mission_a, 1, 1)); },
                                    [](process& p) { p.say(flown(insert(mission_a, 1, 1))); },
                                    [](process& p) { p.say(report_of(2, "look-1")); },
                                    [](process& p) { p.say(flown(tail(mission_a, 2, 2))); },
                                    [](process& p) { p.say(report_of(3, "home-2", 3)); },
                                    [](process& p) { p.say(report_of(4, "w1", 3)); },
                                    [](process&) {}};
    for (std::size_t i = 0; i < steps.size(); ++i) {
      said_.push_back(steps[i]);
      steps[i](*p_);
      run(700ms);
      if (i == 1)
        around.service.faults.push_back({.what = fault::lost_answer, .times = 1, .posts_only = true});
      if (i == 1)
        around.service.faults.push_back({.what = fault::no_connection});
      if (i == 1 && is_stale_)
        around.service.at(mission_a).document.revision = 2;
      if (i == 7)
        around.service.faults.clear();
    }
    run(20s);
  }
  [[nodiscard]] bool was_injected() const { return injected_; }

  outside around;

private:
  void begin_process() {
    p_ = std::make_unique<process>(around);
    for (const auto& each : said_)
      each(*p_);
  }
  [[nodiscard]] std::size_t messages() const {
    std::size_t result = 0;
    for (const auto& each : p_->world.trace().lines())
      result += each.find(" mission_client/") != std::string::npos ? 1 : 0;
    return result;
  }
  void run(std::chrono::milliseconds time) {
    for (std::chrono::milliseconds passed{}; passed < time;) {
      inject();
      if (p_->world.step(0))
        continue;
      p_->exchange();
      if (p_->world.step(0))
        continue;
      p_->world.advance(10ms);
      passed += 10ms;
    }
  }
  void inject() {
    if (injected_ || messages() < what_.after)
      return;
    injected_ = true;
    if (what_.where)
      return p_->world.crash_at("mission_client", *what_.where);
    p_.reset();
    begin_process();
  }

  bool is_stale_;
  injection what_;
  bool injected_ = false;
  std::vector<std::function<void(process&)>> said_;
  std::unique_ptr<process> p_;
};

void expect_nothing_lost(unanswered_flight& f, bool is_stale) {
  const auto& m = f.around.service.at(mission_a);
  EXPECT_EQ(m.changes, is_stale ? 0 : 2);
  EXPECT_EQ(items_told(m), is_stale ? (std::vector<std::string>{"1 w1", "2 w1"})
                                    : (std::vector<std::string>{"1 w1", "2 look-1", "3 home-2", "4 w1"}));
  EXPECT_EQ(f.around.service.unknown_items, 0);
  EXPECT_EQ(f.around.service.other_bodies, 0);
  EXPECT_LE(f.around.service.at_once, 1);
  EXPECT_TRUE(f.around.disk.dead_letters.empty());
  EXPECT_EQ(f.around.listener.outcomes.back().verdict, is_stale ? change_verdict::stale : change_verdict::done);
}

class flown_change_crashes : public testing::TestWithParam<bool> {};

TEST_P(flown_change_crashes, at_every_message_by_a_crash_or_a_kill_lose_and_double_nothing) {
  std::size_t flights = 0;
  for (const auto where : std::initializer_list<std::optional<crash_point>>{
           crash_point::before_handler, crash_point::after_handler, crash_point::after_commit,
           crash_point::before_dispatch, std::nullopt})
    for (std::size_t after = 0;; ++after) {
      SCOPED_TRACE("point " + (where ? std::to_string(static_cast<int>(*where)) : "of a kill") + ", message " +
                   std::to_string(after));
      unanswered_flight f({after, where}, GetParam());
      f.fly();
      ++flights;
      expect_nothing_lost(f, GetParam());
      if (HasFailure())
        return;
      if (!f.was_injected()) {
        EXPECT_GT(after, 30U);
        break;
      }
    }
  RecordProperty("flights", static_cast<int>(flights));
}

INSTANTIATE_TEST_SUITE_P(each, flown_change_crashes, testing::Bool(),
                         [](const auto& is_stale) { return is_stale.param ? "stale" : "taken"; });

} // namespace flown_change_test
