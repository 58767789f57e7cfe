#include <gtest/gtest.h>

#include "actors/vehicle_link/stream_keeper.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages.hpp"
#include "tests/support/time_units.hpp"

namespace stream_keeper_test {

using namespace godwit::vehicle_link;
namespace mavlink = godwit::io::mavlink;

using godwit::tests::ms;
using godwit::tests::s;
constexpr auto attitude = mavlink::attitude::message_id;
constexpr auto position = mavlink::global_position_int::message_id;

send_command asked(const std::optional<stream_keeper::request>& request) {
  return request && std::holds_alternative<send_command>(*request) ? std::get<send_command>(*request) : send_command{};
}

// Lets the wanted message come at INTERVAL_MS until UPTO.
void come(stream_keeper& keeper, std::uint32_t id, std::int64_t from_ns, std::int64_t upto_ns,
          std::int64_t interval_ms) {
  for (auto at = from_ns; at < upto_ns; at += interval_ms * ms)
    keeper.on_message(id);
}

TEST(stream_keeper, asks_for_one_stream_at_a_time) {
  stream_keeper keeper({{attitude, 200}, {position, 500}});
  keeper.begin(0);
  const auto first = asked(keeper.next_request(0));
  EXPECT_EQ(first.command, mavlink::number(mavlink::mav_cmd::set_message_interval));
  EXPECT_EQ(first.param1, static_cast<float>(attitude));
  EXPECT_EQ(first.param2, 200'000.0F);
  EXPECT_FALSE(keeper.next_request(0));
  keeper.on_outcome({}, 10 * ms);
  EXPECT_EQ(asked(keeper.next_request(10 * ms)).param1, static_cast<float>(position));
}

TEST(stream_keeper, asks_no_vehicle_for_what_only_another_autopilot_has) {
  stream_keeper keeper({{attitude, 200, mavlink::mav_autopilot::px4}, {position, 500}});
  keeper.begin(0, mavlink::mav_autopilot::ardupilotmega);
  EXPECT_EQ(asked(keeper.next_request(0)).param1, static_cast<float>(position));
  keeper.on_outcome({}, 0);
  EXPECT_FALSE(keeper.next_request(0));
  EXPECT_TRUE(keeper.missing().empty());
  keeper.begin(s, mavlink::mav_autopilot::px4);
  EXPECT_EQ(asked(keeper.next_request(s)).param1, static_cast<float>(attitude));
}

TEST(stream_keeper, asks_nothing_before_the_vehicle_is_there_and_after_it_has_gone) {
  stream_keeper keeper({{attitude, 200}});
  EXPECT_FALSE(keeper.next_request(0));
  keeper.begin(0);
  keeper.end();
  EXPECT_FALSE(keeper.next_request(100 * s));
  EXPECT_FALSE(keeper.next_deadline_ns());
}

TEST(stream_keeper, a_stream_that_comes_is_left_alone) {
  stream_keeper keeper({{attitude, 200}});
  keeper.begin(0);
  (void)keeper.next_request(0);
  keeper.on_outcome({}, 0);
  for (std::int64_t now = 0; now < 60 * s; now += 3 * s) {
    come(keeper, attitude, now, now + 3 * s, 200);
    EXPECT_FALSE(keeper.next_request(now + 3 * s));
  }
  EXPECT_TRUE(keeper.missing().empty());
}

TEST(stream_keeper, a_refusal_does_not_matter_when_the_message_comes_all_the_same) {
  stream_keeper keeper({{attitude, 1'000}});
  keeper.begin(0);
  (void)keeper.next_request(0);
  command_outcome refused;
  refused.verdict = command_verdict::refused;
  keeper.on_outcome(refused, 0);
  come(keeper, attitude, 0, 3 * s, 1'000);
  EXPECT_FALSE(keeper.next_request(3 * s));
}

TEST(stream_keeper, a_stream_that_stops_is_asked_for_again) {
  stream_keeper keeper({{attitude, 200}});
  keeper.begin(0);
  (void)keeper.next_request(0);
  keeper.on_outcome({}, 0);
  come(keeper, attitude, 0, 3 * s, 200);
  EXPECT_FALSE(keeper.next_request(3 * s));
  EXPECT_EQ(asked(keeper.next_request(6 * s)).param1, static_cast<float>(attitude));
  EXPECT_EQ(keeper.missing(), std::vector{attitude});
}

TEST(stream_keeper, falls_back_to_the_older_request_after_three_tries_and_then_waits_a_minute) {
  stream_keeper keeper({{attitude, 200}});
  keeper.begin(0);
  std::int64_t now = 0;
  for (int i = 0; i < stream_tries; ++i, now += 3 * s) {
    EXPECT_EQ(asked(keeper.next_request(now)).param1, static_cast<float>(attitude)) << i;
    keeper.on_outcome({}, now);
  }
  const auto last = keeper.next_request(now);
  ASSERT_TRUE(last && std::holds_alternative<mavlink::request_data_stream>(*last));
  const auto& older = std::get<mavlink::request_data_stream>(*last);
  EXPECT_EQ(older.req_stream_id, 10); // EXTRA1
  EXPECT_EQ(older.req_message_rate, 5);
  now += 3 * s;
  EXPECT_FALSE(keeper.next_request(now));
  EXPECT_EQ(keeper.next_deadline_ns(), now + stream_retry_ms * ms);
  EXPECT_EQ(asked(keeper.next_request(now + stream_retry_ms * ms)).param1, static_cast<float>(attitude));
}

// An ArduPilot without a receiver for aircraft answers each request with a text to all stations.
TEST(stream_keeper, what_is_occasional_is_asked_for_until_that_is_answered) {
  stream_keeper keeper({{.message = attitude, .interval_ms = 200, .is_optional = true, .is_occasional = true}});
  keeper.begin(0);
  EXPECT_EQ(asked(keeper.next_request(0)).param1, static_cast<float>(attitude));
  keeper.on_outcome({.verdict = command_verdict::timed_out}, s);
  EXPECT_FALSE(keeper.next_request(s));
  EXPECT_EQ(asked(keeper.next_request(10 * s)).param1, static_cast<float>(attitude));
  keeper.on_outcome({.verdict = command_verdict::refused}, 10 * s);
  EXPECT_FALSE(keeper.next_request(500 * s));
  EXPECT_FALSE(keeper.next_deadline_ns());
}

TEST(stream_keeper, what_is_optional_and_does_not_come_is_not_missed_nor_asked_for_by_the_older_request) {
  stream_keeper keeper({{.message = attitude, .interval_ms = 500, .is_optional = true}});
  keeper.begin(0);
  std::int64_t now = 0;
  for (int i = 0; i < stream_tries; ++i, now += 3 * s) {
    EXPECT_EQ(asked(keeper.next_request(now)).param1, static_cast<float>(attitude)) << i;
    keeper.on_outcome({}, now);
  }
  EXPECT_FALSE(keeper.next_request(now));
  EXPECT_TRUE(keeper.missing().empty());
  EXPECT_EQ(keeper.next_deadline_ns(), now + stream_retry_ms * ms);
  EXPECT_EQ(asked(keeper.next_request(now + stream_retry_ms * ms)).param1, static_cast<float>(attitude));
}

TEST(stream_keeper, what_is_wanted_is_bounded) {
  stream_keeper keeper(std::vector<wanted_stream>(100, {attitude, 200}));
  keeper.begin(0);
  std::size_t requests = 0;
  for (; keeper.next_request(0); ++requests)
    keeper.on_outcome({}, 0);
  EXPECT_EQ(requests, max_wanted_streams);
}

} // namespace stream_keeper_test
