#include "actors/fleet_link/news.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace godwit::fleet_link {
namespace news_test {

using json = nlohmann::json;

executor::flight_status flying() {
  executor::flight_status result;
  result.phase = "flying";
  result.authority = "godwit";
  result.mission_id = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";
  result.items = 12;
  return result;
}

std::vector<event_kind> kinds_of(const std::optional<noted>& what) {
  std::vector<event_kind> result;
  for (const auto& each : what ? what->what : std::vector<news>())
    result.push_back(each.kind);
  return result;
}

TEST(fleet_link_news, what_is_as_before_is_no_event) {
  sight seen;
  seen.flight = flying();
  auto now = flying();
  now.sentence = "3 of 12";
  now.state = "another one";
  EXPECT_FALSE(news_of(seen, now));
}

TEST(fleet_link_news, phase_holder_and_progress_are_events_of_their_own) {
  using enum event_kind;
  EXPECT_EQ(kinds_of(news_of(sight{}, flying())), (std::vector{flight, authority, progress}));
  sight seen;
  seen.flight = flying();
  auto now = flying();
  now.items_done = 1;
  EXPECT_EQ(kinds_of(news_of(seen, now)), std::vector{progress});
  now = flying();
  now.authority = "person";
  const auto taken = news_of(seen, now);
  EXPECT_EQ(kinds_of(taken), std::vector{authority});
  EXPECT_EQ(json::parse(taken->what.at(0).data).at("holder"), "person");
  now = flying();
  now.is_armed = true;
  EXPECT_EQ(kinds_of(news_of(seen, now)), std::vector{flight});
}

TEST(fleet_link_news, what_the_failsafe_does_is_an_event_and_the_number_of_its_commands_is_none) {
  sight seen;
  seen.failsafe = failsafe::failsafe_status{};
  auto now = *seen.failsafe;
  now.last_command = 7;
  EXPECT_FALSE(news_of(seen, now));
  now.reacts = failsafe::told_reaction{failsafe::rule::battery_low, failsafe::action::return_home, {}};
  EXPECT_EQ(kinds_of(news_of(seen, now)), std::vector{event_kind::failsafe});
}

TEST(fleet_link_news, an_actor_that_was_restarted_is_an_event_and_a_new_process_counts_anew) {
  state s;
  const auto look = [&](std::uint64_t restarts) {
    runtime::children all;
    all.list.emplace_back().name = "mission_client";
    all.list.back().restarts = restarts;
    all.list.back().last_crash = "killed";
    const auto found = news_of(s.seen, all);
    if (found)
      (void)durable_core::apply(s, *found, 0);
    return found;
  };
  EXPECT_FALSE(look(0));
  const auto crash = look(1);
  ASSERT_EQ(kinds_of(crash), std::vector{event_kind::actor_restarted});
  EXPECT_EQ(json::parse(crash->what.at(0).data).at("reason"), "killed");
  EXPECT_FALSE(look(1));
  EXPECT_TRUE(look(2));
  const auto began = news_of_process(s.seen, "another");
  ASSERT_EQ(kinds_of(began), std::vector{event_kind::process_began});
  (void)durable_core::apply(s, *began, 0);
  EXPECT_FALSE(news_of_process(s.seen, "another"));
  EXPECT_TRUE(look(1));
}

TEST(fleet_link_news, only_the_worst_of_health_is_an_event_and_names_who_is_not_well) {
  health::health_status now;
  now.worst = health::colour::yellow;
  now.parts.push_back({"journal", health::colour::yellow, "the disk is slow", 0});
  now.parts.push_back({"executor", health::colour::green, {}, 0});
  const auto found = news_of(sight{}, now);
  ASSERT_EQ(kinds_of(found), std::vector{event_kind::health});
  EXPECT_EQ(json::parse(found->what.at(0).data).at("parts").size(), 1U);
  sight seen;
  seen.worst = health::colour::yellow;
  now.parts.at(0).reason = "the disk is slower";
  EXPECT_FALSE(news_of(seen, now));
}

} // namespace news_test
} // namespace godwit::fleet_link
