// The planner by itself: what it asks for for in a state, and what it makes of answers.
#include "actors/mission_client/planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "actors/mission_client/core.hpp"

namespace planner_test {

using namespace godwit;
using namespace godwit::mission_client;

const std::string mission_a = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";

// A planner, its state, and a clock; events are applied as they come.
class planning_fixture {
public:
  requests plan() {
    auto all = planner_.plan(s, now);
    auto result = std::move(all);
    while (!result.events.empty()) {
      apply(std::exchange(result.events, {}));
      collect(result, planner_.plan(s, now));
    }
    return result;
  }
  requests answer(ticket number, const service_answer& answer) {
    auto result = planner_.on_answer(s, now, number, answer);
    apply(std::exchange(result.events, {}));
    collect(result, plan());
    return result;
  }
  requests hear(ticket number, const store_answer& answer) {
    auto result = planner_.on_store(s, now, number, answer);
    apply(std::exchange(result.events, {}));
    collect(result, plan());
    return result;
  }
  void happens(const event& what) {
    for (const auto& each : durable_core::apply(s, what, now.wall_ns))
      if (const auto* news = std::get_if<on_disk>(&each))
        planner_.on_disk(*news);
  }
  void advance(std::int64_t by_ns) {
    now.monotonic_ns += by_ns;
    now.wall_ns += by_ns;
  }
  [[nodiscard]] planner& of() { return planner_; }

  state s;
  instant now{0, 1'800'000'000 * second_ns};

private:
  void apply(const std::vector<event>& events) {
    for (const auto& each : events)
      happens(each);
  }
  static void collect(requests& into, requests more) {
    std::ranges::move(more.calls, std::back_inserter(into.calls));
    std::ranges::move(more.questions, std::back_inserter(into.questions));
    std::ranges::move(more.cancelled, std::back_inserter(into.cancelled));
    std::ranges::move(more.events, std::back_inserter(into.events));
  }

  planner planner_{settings{}, 1};
};

report_progress report(std::uint32_t number, const std::string& mission = mission_a) {
  report_progress result;
  result.key = mission + std::to_string(number);
  result.report.mission_id = mission;
  result.report.report_no = number;
  return result;
}

service_answer status(unsigned value, std::string body = {}) { return {.status = value, .body = std::move(body)}; }
const std::string receipt = R"({"stored":1,"repeated":0})";

TEST(mission_client_planner, with_nothing_to_do_it_does_nothing_and_does_not_wake_up) {
  planning_fixture d;
  const auto wanted = d.plan();
  EXPECT_TRUE(wanted.calls.empty());
  EXPECT_TRUE(wanted.questions.empty());
  EXPECT_EQ(d.of().wake_ns(), never_ns);
}

TEST(mission_client_planner, asked_again_it_starts_nothing_twice) {
  planning_fixture d;
  d.happens(report(1));
  EXPECT_EQ(d.plan().calls.size(), 1U);
  EXPECT_TRUE(d.plan().calls.empty());
}

TEST(mission_client_planner, a_new_planner_over_the_same_state_makes_the_same_call_with_the_same_key) {
  planning_fixture first;
  first.happens(report(1));
  first.happens(report(2));
  const auto before = first.plan().calls.at(0).call;
  planning_fixture second;
  second.s = first.s;
  second.of().on_disk({second.s.next_order, false});
  const auto after = second.plan().calls.at(0).call;
  EXPECT_EQ(after.key, before.key);
  EXPECT_EQ(after.body, before.body);
  EXPECT_EQ(after.target, before.target);
}

TEST(mission_client_planner, a_failed_try_is_repeated_when_its_pause_is_over_and_not_before) {
  planning_fixture d;
  d.happens(report(1));
  const auto call = d.plan().calls.at(0);
  EXPECT_TRUE(d.answer(call.number, status(503)).calls.empty());
  const auto wake = d.of().wake_ns();
  EXPECT_GE(wake, second_ns * 4 / 5);
  d.advance(wake - 1);
  EXPECT_TRUE(d.plan().calls.empty());
  d.advance(1);
  const auto again = d.plan();
  ASSERT_EQ(again.calls.size(), 1U);
  EXPECT_EQ(again.calls[0].call.key, call.call.key);
}

TEST(mission_client_planner, a_lane_that_fails_does_not_hold_up_another) {
  planning_fixture d;
  d.happens(report(1));
  d.happens(report(1, "0b8f7c36-3a5f-4c0b-8f0e-5e5f2f6f9b11"));
  const auto calls = d.plan().calls;
  ASSERT_EQ(calls.size(), 2U);
  (void)d.answer(calls[0].number, status(503));
  (void)d.answer(calls[1].number, status(200, receipt));
  EXPECT_EQ(d.s.rows.size(), 1U);
}

TEST(mission_client_planner, a_hundred_reports_go_together_and_the_next_ones_only_after_them) {
  planning_fixture d;
  for (std::uint32_t i = 1; i <= 150; ++i)
    d.happens(report(i));
  const auto first = d.plan();
  ASSERT_EQ(first.calls.size(), 1U);
  const auto second = d.answer(first.calls[0].number, status(200, receipt));
  EXPECT_EQ(d.s.rows.size(), 50U);
  ASSERT_EQ(second.calls.size(), 1U);
  (void)d.answer(second.calls[0].number, status(200, receipt));
  EXPECT_TRUE(d.s.rows.empty());
}

TEST(mission_client_planner, after_a_conflict_no_later_report_of_the_mission_goes_out) {
  planning_fixture d;
  for (std::uint32_t i = 1; i <= 150; ++i)
    d.happens(report(i));
  const auto first = d.plan();
  ASSERT_EQ(first.calls.size(), 1U);
  EXPECT_TRUE(d.answer(first.calls[0].number, status(409)).calls.empty());
  d.advance(3'600 * second_ns);
  EXPECT_TRUE(d.plan().calls.empty());
}

TEST(mission_client_planner, an_answer_that_nobody_waits_for_changes_nothing) {
  planning_fixture d;
  d.happens(report(1));
  const auto call = d.plan().calls.at(0);
  (void)d.answer(call.number, status(200, receipt));
  EXPECT_TRUE(d.s.rows.empty());
  EXPECT_TRUE(d.answer(call.number, status(410)).events.empty());
  EXPECT_FALSE(is_deleted(d.s, mission_a));
}

TEST(mission_client_planner, what_is_not_on_the_disk_is_not_sent) {
  planning_fixture d;
  (void)durable_core::apply(d.s, report(1), d.now.wall_ns); // its on_disk does not come
  EXPECT_TRUE(d.plan().calls.empty());
  d.of().on_disk({d.s.next_order, false});
  EXPECT_EQ(d.plan().calls.size(), 1U);
}

TEST(mission_client_planner,
     of_the_lanes_that_nobody_waits_for_only_a_few_are_under_way_and_a_change_goes_out_at_once) {
  planning_fixture d;
  for (int i = 0; i < 9; ++i)
    d.happens(report(1, "m" + std::to_string(i)));
  EXPECT_EQ(d.plan().calls.size(), max_deliveries_under_way);
  insert_waypoint change;
  change.mission_id = mission_a;
  change.insert.idempotency_key = "k";
  d.happens(change);
  const auto wanted = d.plan();
  ASSERT_EQ(wanted.calls.size(), 1U);
  EXPECT_EQ(wanted.calls[0].call.target, "/missions/" + mission_a + "/waypoints");
  EXPECT_LE(wanted.calls[0].call.total_timeout, std::chrono::seconds(2));
}

TEST(mission_client_planner, a_change_that_waits_longer_than_its_window_fails_and_its_call_is_given_up) {
  planning_fixture d;
  insert_waypoint change;
  change.mission_id = mission_a;
  change.insert.idempotency_key = "k";
  d.happens(change);
  const auto call = d.plan().calls.at(0);
  d.advance(change_window_ns);
  EXPECT_EQ(d.plan().cancelled, std::vector<ticket>{call.number});
  EXPECT_TRUE(d.s.rows.empty());
}

TEST(mission_client_planner, a_batch_is_posted_told_to_the_store_and_only_then_done) {
  planning_fixture d;
  d.happens(push_map{mission_a});
  auto wanted = d.plan();
  ASSERT_EQ(wanted.questions.size(), 2U); // one for each destination
  const auto asked = std::get<store::take_batch>(wanted.questions[0].question);
  EXPECT_EQ(asked.key, d.s.rows.at(0).key);
  store::batch rows{asked.key, mission_a, asked.to, {}, {}, 0, store::map_failure::none, {}};
  rows.observations.push_back({"9a6c2b1e-0f4d-4b7a-8c3d-2e1f0a9b8c7d",
                               mission_a,
                               {},
                               store::observation_kind::found,
                               "vehicle",
                               {47.4, 8.5, {}},
                               0,
                               0.5});
  wanted = d.hear(wanted.questions[0].number, rows);
  ASSERT_EQ(wanted.calls.size(), 1U);
  EXPECT_EQ(wanted.calls[0].call.key, asked.key);
  EXPECT_EQ(d.of().status(d.s).push_pending, 1U);
  wanted = d.answer(wanted.calls[0].number, status(200, receipt));
  ASSERT_EQ(wanted.questions.size(), 1U);
  EXPECT_EQ(std::get<store::batch_delivered>(wanted.questions[0].question).key, asked.key);
  EXPECT_NE(find_row(d.s.rows, asked.key), nullptr);
  wanted = d.hear(wanted.questions[0].number, store_silent{"no answer"}); // it is asked again, and not posted again
  EXPECT_TRUE(wanted.calls.empty());
  d.advance(2 * second_ns);
  wanted = d.plan();
  ASSERT_EQ(wanted.questions.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<store::batch_delivered>(wanted.questions[0].question));
  (void)d.hear(wanted.questions[0].number, store::map_answer{});
  EXPECT_EQ(find_row(d.s.rows, asked.key), nullptr);
}

TEST(mission_client_planner, a_store_that_says_delivered_ends_the_delivery) {
  planning_fixture d;
  d.happens(push_map{mission_a});
  const auto wanted = d.plan();
  const auto key = std::get<store::take_batch>(wanted.questions[0].question).key;
  store::batch rows;
  rows.failure = store::map_failure::delivered;
  (void)d.hear(wanted.questions[0].number, rows);
  EXPECT_EQ(find_row(d.s.rows, key), nullptr);
}

TEST(mission_client_planner, the_load_begins_before_the_first_page_is_asked_for) {
  planning_fixture d;
  d.happens(begin_mission{mission_a});
  auto wanted = d.plan();
  EXPECT_TRUE(std::holds_alternative<store::get_batches>(wanted.questions.at(0).question));
  wanted = d.hear(wanted.questions[0].number, store::open_batches{});
  EXPECT_TRUE(std::holds_alternative<store::get_owed>(wanted.questions.at(0).question));
  wanted = d.hear(wanted.questions[0].number, store::owed_list{});
  ASSERT_EQ(wanted.calls.size(), 1U);
  EXPECT_EQ(wanted.calls[0].call.target, "/missions/" + mission_a);
  mission::document document;
  document.mission_id = mission_a;
  d.happens(mission_fetched{document, {}});
  wanted = d.plan();
  EXPECT_TRUE(std::holds_alternative<store::choose_mission>(wanted.questions.at(0).question));
  wanted = d.hear(wanted.questions[0].number, store::map_answer{});
  EXPECT_TRUE(std::holds_alternative<store::begin_load>(wanted.questions.at(0).question));
  EXPECT_TRUE(wanted.calls.empty());
  wanted = d.hear(wanted.questions[0].number, store::load_answer{7, store::map_failure::none, {}});
  ASSERT_EQ(wanted.calls.size(), 1U);
  EXPECT_EQ(wanted.calls[0].call.target, "/missions/" + mission_a + "/mapobjects?limit=2000");
  EXPECT_TRUE(wanted.calls[0].call.is_page);
}

// A planner whose store has begun a load; the first page is asked for.
requests at_the_first_page(planning_fixture& d) {
  d.happens(begin_mission{mission_a});
  auto wanted = d.plan();
  wanted = d.hear(wanted.questions.at(0).number, store::open_batches{});
  wanted = d.hear(wanted.questions.at(0).number, store::owed_list{});
  mission::document document;
  document.mission_id = mission_a;
  d.happens(mission_fetched{document, {}});
  wanted = d.plan();
  wanted = d.hear(wanted.questions.at(0).number, store::map_answer{});
  return d.hear(wanted.questions.at(0).number, store::load_answer{7, store::map_failure::none, {}});
}

std::string page(const std::string& list, const std::string& next) {
  return R"({"schema_version":"1.0.0",")" + list + R"(":[])" + (next.empty() ? "" : R"(,"next":")" + next + "\"") + "}";
}

TEST(mission_client_planner, a_page_is_asked_for_while_earlier_ones_go_into_the_store_and_two_wait_at_most) {
  planning_fixture d;
  auto wanted = at_the_first_page(d);
  wanted = d.answer(wanted.calls.at(0).number, status(200, page("map_objects", "b")));
  ASSERT_EQ(wanted.questions.size(), 1U);
  const auto first = wanted.questions[0];
  EXPECT_EQ(std::get<store::load_page>(first.question).number, 0);
  ASSERT_EQ(wanted.calls.size(), 1U) << "the store has not answered yet";
  EXPECT_TRUE(wanted.calls[0].call.target.ends_with("&next=b"));
  wanted = d.answer(wanted.calls[0].number, status(200, page("map_objects", "c")));
  EXPECT_TRUE(wanted.calls.empty()) << "two pages wait";
  EXPECT_TRUE(wanted.questions.empty()) << "one at a time, in their order";
  wanted = d.hear(first.number, store::load_answer{7, store::map_failure::none, {}});
  ASSERT_EQ(wanted.questions.size(), 1U);
  EXPECT_EQ(std::get<store::load_page>(wanted.questions[0].question).number, 1);
  ASSERT_EQ(wanted.calls.size(), 1U);
  EXPECT_TRUE(wanted.calls[0].call.target.ends_with("&next=c"));
}

service_answer begun(const std::string& next) { return {.how = ending::page_begun, .status = 200, .body = next}; }

TEST(mission_client_planner, a_page_whose_place_the_head_of_the_one_before_names_is_asked_for_before_that_has_come) {
  planning_fixture d;
  const auto first = at_the_first_page(d).calls.at(0).number;
  auto wanted = d.answer(first, begun("b"));
  ASSERT_EQ(wanted.calls.size(), 1U);
  const auto second = wanted.calls[0].number;
  EXPECT_TRUE(wanted.calls[0].call.target.ends_with("&next=b"));
  EXPECT_TRUE(d.answer(first, begun("b")).calls.empty()) << "once";
  EXPECT_TRUE(d.answer(second, begun("c")).calls.empty()) << "one ahead";
  EXPECT_TRUE(d.answer(second, status(200, page("map_objects", "c"))).questions.empty()) << "they stay in their order";
  wanted = d.answer(first, status(200, page("map_objects", "b")));
  ASSERT_EQ(wanted.questions.size(), 1U);
  EXPECT_EQ(std::get<store::load_page>(wanted.questions[0].question).number, 0);
  EXPECT_TRUE(wanted.calls.empty()) << "two pages wait";
  wanted = d.hear(wanted.questions[0].number, store::load_answer{7, store::map_failure::none, {}});
  EXPECT_EQ(std::get<store::load_page>(wanted.questions.at(0).question).number, 1);
  EXPECT_TRUE(wanted.calls.at(0).call.target.ends_with("&next=c"));
}

TEST(mission_client_planner, what_the_body_of_a_page_says_of_the_next_one_counts_and_not_its_head) {
  planning_fixture d;
  const auto first = at_the_first_page(d).calls.at(0).number;
  const auto ahead = d.answer(first, begun("x")).calls.at(0).number;
  const auto wanted = d.answer(first, status(200, page("map_objects", "b")));
  EXPECT_EQ(wanted.cancelled, std::vector<ticket>{ahead});
  ASSERT_EQ(wanted.calls.size(), 1U);
  EXPECT_TRUE(wanted.calls[0].call.target.ends_with("&next=b"));
}

TEST(mission_client_planner, a_page_ahead_that_fails_is_asked_for_again_in_its_turn_and_ends_no_pull) {
  for (const auto& failure : {status(400), status(503), service_answer{.how = ending::bad_answer}}) {
    planning_fixture d;
    const auto first = at_the_first_page(d).calls.at(0).number;
    const auto ahead = d.answer(first, begun("b")).calls.at(0).number;
    EXPECT_TRUE(d.answer(ahead, failure).calls.empty());
    const auto wanted = d.answer(first, status(200, page("map_objects", "b")));
    ASSERT_EQ(wanted.calls.size(), 1U);
    EXPECT_TRUE(wanted.calls[0].call.target.ends_with("&next=b"));
    EXPECT_EQ(d.s.now, phase::pulling);
  }
}

TEST(mission_client_planner, a_load_is_finished_when_the_store_has_the_last_page_and_not_when_that_has_come) {
  planning_fixture d;
  auto wanted = at_the_first_page(d);
  wanted = d.answer(wanted.calls.at(0).number, status(200, page("map_objects", "")));
  const auto objects = wanted.questions.at(0).number;
  wanted = d.answer(wanted.calls.at(0).number, status(200, page("ignored_items", "")));
  EXPECT_TRUE(wanted.calls.empty());
  EXPECT_TRUE(wanted.questions.empty());
  wanted = d.hear(objects, store::load_answer{7, store::map_failure::none, {}});
  EXPECT_EQ(std::get<store::load_page>(wanted.questions.at(0).question).number, 1);
  wanted = d.hear(wanted.questions[0].number, store::load_answer{7, store::map_failure::none, {}});
  EXPECT_EQ(std::get<store::finish_load>(wanted.questions.at(0).question).load, 7);
}

TEST(mission_client_planner, a_load_that_the_store_gives_up_takes_nothing_of_the_pages_that_were_asked_ahead) {
  planning_fixture d;
  auto wanted = at_the_first_page(d);
  wanted = d.answer(wanted.calls.at(0).number, status(200, page("map_objects", "b")));
  const auto ahead = wanted.calls.at(0).number;
  wanted = d.hear(wanted.questions.at(0).number, store::load_answer{7, store::map_failure::load_given_up, {}});
  EXPECT_EQ(wanted.cancelled, std::vector<ticket>{ahead});
  ASSERT_TRUE(std::holds_alternative<store::begin_load>(wanted.questions.at(0).question));
  const auto begun = wanted.questions[0].number;
  wanted = d.answer(ahead, status(200, page("map_objects", "c")));
  EXPECT_TRUE(wanted.questions.empty() && wanted.calls.empty()) << "it came all the same";
  wanted = d.hear(begun, store::load_answer{8, store::map_failure::none, {}});
  ASSERT_EQ(wanted.calls.size(), 1U);
  EXPECT_TRUE(wanted.calls[0].call.target.ends_with("/mapobjects?limit=2000"));
}

} // namespace planner_test
