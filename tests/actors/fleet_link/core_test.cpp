#include "actors/fleet_link/core.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "io/fields/json_text.hpp"
#include "tests/actors/fleet_link/fleet_world.hpp"

namespace godwit::fleet_link {
namespace fleet_link_core_test {

using namespace godwit::tests;
using failure = broker_failure;
using json = nlohmann::json;

std::vector<std::uint64_t> numbers(const fleet_world& world) {
  std::vector<std::uint64_t> result;
  for (const auto& each : world.received)
    result.push_back(json::parse(each).at("number"));
  return result;
}

text_ptr text_of(const std::string& topic, int number) {
  return std::make_shared<const std::string>(R"({"topic":")" + topic + R"(","number":)" + std::to_string(number) +
                                             R"(,"at_ms":1,"data":{}})");
}

TEST(fleet_link_core, an_event_goes_to_the_broker_when_it_is_on_the_disk_and_not_before) {
  fleet_world world;
  world.turn();
  world.accept();
  world.note(1);
  world.turn();
  EXPECT_EQ(world.on_the_way.size(), 1U) << "that the vehicle is there";
  world.sync();
  world.turn();
  ASSERT_EQ(world.on_the_way.size(), 2U);
  while (world.take()) {
  }
  const auto event = json::parse(world.received.at(0));
  EXPECT_EQ(event.at("id"), "5707e-1");
  EXPECT_EQ(event.at("kind"), "progress");
  EXPECT_EQ(event.at("at_ms"), world.now().wall_ns / 1'000'000);
  EXPECT_EQ(event.at("historical"), false);
  EXPECT_EQ(event.at("data").at("items_done"), 1);
  world.turn();
  EXPECT_TRUE(world.state.events.empty());
  EXPECT_EQ(world.state.delivered, 1U);
}

TEST(fleet_link_core, what_happened_without_a_broker_comes_in_order_and_is_marked) {
  fleet_world world;
  for (std::uint32_t i = 1; i <= 100; ++i)
    world.note(i);
  world.deliver_all();
  ASSERT_EQ(world.received.size(), 100U);
  EXPECT_TRUE(std::ranges::is_sorted(numbers(world)));
  EXPECT_EQ(json::parse(world.received.front()).at("historical"), true);
}

TEST(fleet_link_core, the_broker_is_handed_no_more_than_a_window) {
  fleet_world world;
  for (std::uint32_t i = 1; i <= 100; ++i)
    world.note(i);
  world.sync();
  world.turn();
  world.accept();
  world.wait(10 * fleet_second);
  EXPECT_EQ(world.on_the_way.size(), core::max_window + 1); // and that it is there
  ASSERT_TRUE(world.take());
  ASSERT_TRUE(world.take());
  world.turn();
  EXPECT_EQ(world.on_the_way.size(), core::max_window);
}

TEST(fleet_link_core, large_events_make_the_window_shorter) {
  fleet_world world;
  for (int i = 0; i < 20; ++i)
    world.apply(noted{{{event_kind::health, "\"" + std::string(12'000, 'a') + "\""}}, false, {}});
  world.sync();
  world.turn();
  world.accept();
  world.turn();
  EXPECT_EQ(world.on_the_way.size(), 3U + 1U);
}

TEST(fleet_link_core, what_was_not_acknowledged_goes_again_with_the_same_id_and_text) {
  fleet_world world;
  world.note(1);
  world.note(2);
  world.sync();
  world.turn();
  world.accept();
  world.turn();
  while (world.take(false)) {
  }
  world.refuse(failure::lost);
  world.wait(3 * fleet_second);
  world.accept();
  world.turn();
  while (world.take()) {
  }
  ASSERT_EQ(world.received.size(), 4U);
  EXPECT_EQ(world.received.at(0), world.received.at(2));
  EXPECT_EQ(world.received.at(1), world.received.at(3));
}

TEST(fleet_link_core, acknowledgements_out_of_order_keep_what_is_before_them) {
  fleet_world world;
  world.note(1);
  world.note(2);
  world.sync();
  world.turn();
  world.accept();
  world.turn();
  world.core.on_taken({*world.attempt, 2});
  world.turn();
  EXPECT_EQ(world.state.events.size(), 2U);
  world.core.on_taken({*world.attempt, 1});
  world.turn();
  EXPECT_TRUE(world.state.events.empty());
}

TEST(fleet_link_core, an_acknowledgement_of_an_earlier_connection_is_none) {
  fleet_world world;
  world.note(1);
  world.sync();
  world.turn();
  world.accept();
  world.turn();
  const auto before = *world.attempt;
  world.refuse(failure::lost);
  world.wait(3 * fleet_second);
  world.accept();
  world.turn();
  world.core.on_taken({before, 1});
  world.turn();
  EXPECT_EQ(world.state.events.size(), 1U);
}

TEST(fleet_link_core, the_vehicle_is_online_when_connected_and_the_brokers_will_says_offline_of_the_same_session) {
  fleet_world world;
  world.turn();
  world.accept();
  ASSERT_TRUE(world.take());
  const auto& birth = world.others.at(0);
  EXPECT_EQ(birth.topic, "gw/v1/rover-7/status");
  EXPECT_EQ(birth.how, publication::kind::status);
  EXPECT_EQ(json::parse(*birth.payload).at("state"), "online");
  EXPECT_EQ(world.will.topic, birth.topic);
  EXPECT_EQ(json::parse(*world.will.payload).at("state"), "offline");
  EXPECT_EQ(json::parse(*world.will.payload).at("session"), json::parse(*birth.payload).at("session"));
}

TEST(fleet_link_core, pauses_grow_to_a_minute_and_are_never_below_a_second) {
  fleet_world world;
  std::int64_t longest = 0;
  for (int tries = 0; tries < 200; ++tries) {
    world.turn();
    world.refuse(failure::unreachable);
    const auto pause = world.core.next_due_ns() - world.now_ns;
    EXPECT_GE(pause, core::shortest_pause_ns);
    EXPECT_LE(pause, tries == 0 ? 2 * fleet_second : core::longest_pause_ns);
    longest = std::max(longest, pause);
    world.now_ns += pause;
  }
  EXPECT_GT(longest, 50 * fleet_second);
}

TEST(fleet_link_core, a_broker_that_held_for_a_while_is_tried_again_soon) {
  fleet_world world;
  for (int tries = 0; tries < 10; ++tries) {
    world.turn();
    world.refuse(failure::unreachable);
    world.now_ns = world.core.next_due_ns();
  }
  world.turn();
  world.accept();
  world.wait(40 * fleet_second);
  world.refuse(failure::lost);
  EXPECT_LE(world.core.next_due_ns() - world.now_ns, 2 * fleet_second);
}

TEST(fleet_link_core, a_broker_that_says_nothing_is_given_up_and_tried_again) {
  fleet_world world;
  world.turn();
  ASSERT_TRUE(world.attempt);
  world.wait(core::open_patience_ns + fleet_second);
  EXPECT_FALSE(world.core.health(world.state).reason.empty());
  world.wait(3 * fleet_second);
  ASSERT_TRUE(world.attempt);
  world.accept();
  EXPECT_TRUE(world.core.is_connected());
}

TEST(fleet_link_core, why_there_is_no_broker_is_told_once_with_what_to_do_and_stands_in_health) {
  fleet_world world;
  for (int tries = 0; tries < 5; ++tries) {
    world.turn();
    world.refuse(failure::certificate, "its certificate has expired");
    world.now_ns = world.core.next_due_ns();
  }
  ASSERT_EQ(world.told.size(), 1U);
  EXPECT_NE(world.told.at(0).find("its certificate has expired"), std::string::npos);
  EXPECT_NE(world.told.at(0).find("telemetry.ca_file"), std::string::npos);
  const auto health = world.core.health(world.state);
  EXPECT_EQ(health.how, runtime::health_colour::yellow);
  EXPECT_NE(health.reason.find("telemetry.ca_file"), std::string::npos);
  world.turn();
  world.accept();
  EXPECT_EQ(world.core.health(world.state).how, runtime::health_colour::green);
  EXPECT_EQ(world.told.size(), 2U) << "that it is connected again";
}

TEST(fleet_link_core, of_what_is_live_the_newest_goes_out_and_not_more_often_than_is_set) {
  fleet_world world;
  world.turn();
  world.accept();
  for (int i = 1; i <= 100; ++i) {
    world.core.on_text(text_of("position", i));
    world.wait(fleet_second / 10);
    while (world.take()) {
    }
  }
  std::vector<int> shown;
  for (const auto& each : world.others)
    if (each.topic == "gw/v1/rover-7/telemetry/position") {
      EXPECT_EQ(each.how, publication::kind::live);
      shown.push_back(json::parse(*each.payload).at("number"));
    }
  EXPECT_GE(shown.size(), 9U);
  EXPECT_LE(shown.size(), 11U);
  EXPECT_GE(shown.back(), 88);
}

TEST(fleet_link_core, how_things_stand_is_kept_by_the_broker_and_goes_again_with_each_connection) {
  fleet_world world;
  world.core.on_text(text_of("flight", 1));
  world.core.on_text(text_of("log", 2));
  const auto shown = [&] {
    return std::ranges::count_if(world.others, [](const publication& each) {
      return each.topic == "gw/v1/rover-7/state/flight" && each.how == publication::kind::kept;
    });
  };
  for (int connections = 1; connections <= 3; ++connections) {
    world.wait(10 * fleet_second);
    world.accept();
    world.wait(3 * fleet_second);
    while (world.take()) {
    }
    EXPECT_EQ(shown(), connections);
    world.refuse(failure::lost);
  }
  EXPECT_TRUE(std::ranges::none_of(world.others, [](const publication& each) {
    return each.topic.find("log") != std::string::npos;
  })) << "the log stays on the vehicle";
}

TEST(fleet_link_core, a_network_that_takes_nothing_holds_back_what_is_live_and_then_gets_the_newest) {
  fleet_world world;
  world.turn();
  world.accept();
  for (int i = 1; i <= 600; ++i) {
    world.core.on_text(text_of("position", i));
    world.wait(fleet_second);
  }
  EXPECT_LE(world.on_the_way.size(), core::max_unsent_texts + 1);
  EXPECT_GT(world.core.view_of(world.state, world.now()).skipped, 500U);
  while (world.take()) {
  }
  world.wait(fleet_second);
  ASSERT_TRUE(world.take());
  EXPECT_EQ(json::parse(*world.others.back().payload).at("number"), 600);
}

TEST(fleet_link_core, what_the_broker_does_not_take_is_counted_and_an_event_goes_without_its_data) {
  fleet_world world;
  world.max_packet_bytes = 1'024;
  noted what = tests::progress_news(1);
  what.what.front().data = R"({"long":")" + std::string(2'000, 'x') + R"("})";
  world.apply(what);
  world.note(2);
  world.core.on_text(text_of("position", 1));
  world.core.on_text(
      std::make_shared<const std::string>(R"({"topic":"health","x":")" + std::string(2'000, 'x') + R"("})"));
  world.deliver_all();
  while (world.take()) {
  }
  ASSERT_EQ(world.received.size(), 2U);
  EXPECT_EQ(json::parse(world.received.front()).at("data"), json::object());
  EXPECT_EQ(json::parse(world.received.back()).at("data").at("items_done"), 2);
  EXPECT_TRUE(std::ranges::none_of(world.others, [](const auto& each) { return each.payload->size() > 1'024; }));
  EXPECT_EQ(world.core.view_of(world.state, world.now()).too_large, 2U);
  EXPECT_TRUE(world.state.events.empty());
}

TEST(fleet_link_core, without_room_the_oldest_events_are_dropped_counted_and_said) {
  fleet_world world;
  for (std::uint32_t i = 1; i <= max_events + 1; ++i)
    world.note(i);
  EXPECT_LE(world.state.events.size(), max_events);
  EXPECT_EQ(world.state.dropped + world.state.events.size(), max_events + 1);
  EXPECT_EQ(world.state.events.front().number, world.state.dropped + 1);
  EXPECT_EQ(world.state.events.back().number, max_events + 1);
  world.sync();
  world.turn();
  world.accept();
  EXPECT_NE(world.core.health(world.state).reason.find("dropped"), std::string::npos);
  world.deliver_all();
  EXPECT_EQ(world.received.size(), max_events + 1 - world.state.dropped);
}

TEST(fleet_link_core, events_that_are_dropped_while_they_are_on_their_way_harm_nothing) {
  fleet_world world;
  for (std::uint32_t i = 1; i <= max_events; ++i)
    world.note(i);
  world.sync();
  world.turn();
  world.accept();
  world.turn();
  world.note(max_events + 1); // drops what the window holds
  world.deliver_all();
  EXPECT_TRUE(world.state.events.empty());
  EXPECT_TRUE(std::ranges::is_sorted(numbers(world)));
}

} // namespace fleet_link_core_test
} // namespace godwit::fleet_link
