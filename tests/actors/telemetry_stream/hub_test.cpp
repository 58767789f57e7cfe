#include "actors/telemetry_stream/hub.hpp"

#include <algorithm>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace hub_test {

using namespace godwit::telemetry_stream;
using nlohmann::json;

const std::vector<wanted_topic> position_and_flight{{topic::position, 0}, {topic::flight, 0}};

std::vector<json> all_of(subscriber& who) {
  std::vector<json> result;
  while (const auto text = who.take())
    result.push_back(json::parse(*text));
  return result;
}

std::vector<json> after_hello(subscriber& who) {
  auto result = all_of(who);
  EXPECT_FALSE(result.empty());
  result.erase(result.begin());
  return result;
}

struct stream {
  hub all{77};
  std::int64_t now_ns = 1'000'000'000;
  int woken = 0;

  void say(topic what, const json& data) { all.publish(what, data.dump(), 5, now_ns); }
  std::shared_ptr<subscriber> join(const std::vector<wanted_topic>& wanted = position_and_flight,
                                   const queue_bounds& bounds = {}) {
    auto made = all.subscribe(
        wanted, [this] { ++woken; }, bounds);
    EXPECT_TRUE(made);
    return *made;
  }
};

TEST(hub, a_subscriber_hears_what_the_stream_is_then_the_newest_of_its_topics_then_all_changes) {
  stream s;
  s.say(topic::flight, "ready");
  s.say(topic::position, 1);
  s.say(topic::position, 2);
  s.say(topic::battery, 50);
  const auto who = s.join();
  s.say(topic::position, 3);
  const auto heard = all_of(*who);
  ASSERT_EQ(heard.size(), 4U);
  EXPECT_EQ(heard[0], json::parse(R"({"topic":"stream","data":{"session":"77"}})"));
  EXPECT_EQ(heard[1].at("data"), "ready");
  EXPECT_EQ(heard[2].at("data"), 2);
  EXPECT_EQ(heard[3], json::parse(R"({"topic":"position","number":5,"at_ms":5,"data":3})"));
}

TEST(hub, what_nobody_wants_reaches_nobody_but_everybody_hears_the_clock) {
  stream s;
  const auto who = s.join({{topic::health, 0}});
  s.say(topic::battery, 50);
  s.say(topic::clock, 1);
  const auto heard = after_hello(*who);
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard[0].at("topic"), "clock");
}

TEST(hub, a_text_is_made_once_and_shared_by_all) {
  stream s;
  const auto one = s.join();
  const auto other = s.join();
  (void)all_of(*one);
  (void)all_of(*other);
  s.say(topic::position, 1);
  EXPECT_EQ(one->take().get(), other->take().get());
}

TEST(hub, of_data_the_oldest_are_dropped_counted_and_told_before_the_rest) {
  stream s;
  const auto who = s.join(position_and_flight, {.max_data = 3});
  (void)all_of(*who);
  for (int i = 1; i <= 10; ++i)
    s.say(topic::position, i);
  const auto heard = all_of(*who);
  ASSERT_EQ(heard.size(), 4U);
  EXPECT_EQ(heard[0], json::parse(R"({"topic":"stream","data":{"dropped":{"position":7}}})"));
  EXPECT_EQ(heard[1].at("data"), 8);
  EXPECT_EQ(heard[3].at("data"), 10);
  EXPECT_EQ(who->dropped()[static_cast<std::size_t>(topic::position)], 7U);
  EXPECT_EQ(s.all.counts().dropped[static_cast<std::size_t>(topic::position)], 7U);
  s.say(topic::position, 11);
  EXPECT_EQ(all_of(*who).size(), 1U) << "it is told once";
}

TEST(hub, what_must_not_be_missed_is_never_dropped_but_ends_who_is_too_slow) {
  stream s;
  const auto slow = s.join(position_and_flight, {.max_events = 3});
  const auto quick = s.join(position_and_flight, {.max_events = 3});
  (void)all_of(*slow);
  for (int i = 0; i < 4; ++i) {
    s.say(topic::flight, i);
    EXPECT_FALSE(all_of(*quick).empty());
  }
  EXPECT_TRUE(slow->has_ended());
  EXPECT_EQ(slow->take(), nullptr);
  EXPECT_EQ(slow->waiting_bytes(), 0U);
  EXPECT_FALSE(quick->has_ended());
  EXPECT_EQ(s.all.counts().ended, 1U);
  const auto dropped = s.all.counts().dropped;
  EXPECT_EQ(std::ranges::count(dropped, 0U), static_cast<std::ptrdiff_t>(topic_count));
}

TEST(hub, a_reader_that_never_comes_costs_no_more_than_its_bounds) {
  stream s;
  const queue_bounds bounds{};
  const auto who = s.join();
  for (int i = 0; i < 10'000; ++i)
    s.say(topic::position, std::string(1000, 'x'));
  EXPECT_LE(who->waiting_bytes(), bounds.max_data_bytes + bounds.max_event_bytes);
  for (int i = 0; i < 200; ++i)
    s.say(topic::flight, std::string(10'000, 'x'));
  EXPECT_TRUE(who->has_ended()) << "by its bytes";
}

TEST(hub, the_order_is_that_in_which_it_was_said_whatever_the_queue) {
  stream s;
  const auto who = s.join();
  for (int i = 0; i < 20; ++i)
    s.say(i % 3 == 0 ? topic::flight : topic::position, i);
  const auto heard = after_hello(*who);
  ASSERT_EQ(heard.size(), 20U);
  for (int i = 0; i < 20; ++i)
    EXPECT_EQ(heard[static_cast<std::size_t>(i)].at("data"), i);
}

TEST(hub, data_comes_at_most_as_often_as_it_was_wanted_and_events_always_do) {
  stream s;
  const auto who = s.join({{topic::position, 500'000'000}, {topic::flight, 500'000'000}});
  (void)all_of(*who);
  for (int i = 0; i < 10; ++i, s.now_ns += 100'000'000) {
    s.say(topic::position, i);
    s.say(topic::flight, i);
  }
  const auto heard = all_of(*who);
  EXPECT_EQ(std::ranges::count_if(heard, [](const json& each) { return each.at("topic") == "position"; }), 2);
  EXPECT_EQ(std::ranges::count_if(heard, [](const json& each) { return each.at("topic") == "flight"; }), 10);
}

TEST(hub, a_reader_is_woken_once_until_it_has_taken_all) {
  stream s;
  const auto who = s.join();
  (void)all_of(*who);
  for (int i = 0; i < 5; ++i)
    s.say(topic::position, i);
  EXPECT_EQ(s.woken, 1);
  (void)all_of(*who);
  s.say(topic::position, 6);
  EXPECT_EQ(s.woken, 2);
}

TEST(hub, who_has_let_go_of_its_place_hears_nothing_and_counts_no_more) {
  stream s;
  auto who = s.join();
  EXPECT_EQ(s.all.counts().subscribers, 1U);
  who.reset();
  s.say(topic::position, 1);
  EXPECT_EQ(s.woken, 0);
  EXPECT_EQ(s.all.counts().subscribers, 0U);
}

TEST(hub, subscribers_are_bounded) {
  stream s;
  std::vector<std::shared_ptr<subscriber>> all;
  for (std::size_t i = 0; i < hub::max_subscribers; ++i)
    all.push_back(s.join());
  EXPECT_FALSE(s.all.subscribe(position_and_flight, [] {}));
  all.pop_back();
  EXPECT_TRUE(s.all.subscribe(position_and_flight, [] {}));
}

TEST(hub, publishers_and_readers_of_many_threads_neither_lose_nor_double_an_event) {
  hub all;
  const auto who =
      all.subscribe({{topic::flight, 0}}, [] {}, {.max_events = 100'000, .max_event_bytes = 100 << 20}).value();
  constexpr int each = 2000;
  std::vector<std::thread> publishers;
  for (int t = 0; t < 3; ++t)
    publishers.emplace_back([&] {
      for (int i = 0; i < each; ++i)
        all.publish(topic::flight, "1", 1, 1);
    });
  int heard = 0;
  std::uint64_t last = 0;
  for (auto& t : publishers)
    t.join();
  while (const auto text = who->take()) {
    const auto said = json::parse(*text);
    if (said.at("topic") != "flight")
      continue;
    ++heard;
    EXPECT_GT(said.at("number").get<std::uint64_t>(), last);
    last = said.at("number").get<std::uint64_t>();
  }
  EXPECT_EQ(heard, 3 * each);
}

} // namespace hub_test
