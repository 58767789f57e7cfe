#include "actors/ground_port/forward_gate.hpp"

#include <gtest/gtest.h>

#include "actors/ground_port/settings.hpp"
#include "tests/support/time_units.hpp"

namespace godwit::ground_port {
namespace forward_gate_test {

using godwit::tests::ms;

// How many of a stream at HZ pass in ten seconds.
template <class M>
int passing(forward_gate& gate, int hz) {
  int result = 0;
  for (int i = 0; i < 10 * hz; ++i)
    result += gate.take(M{}, i * (1'000 * ms / hz)) ? 1 : 0;
  return result;
}

TEST(forward_gate, a_stream_faster_than_its_interval_is_thinned_out_and_counted) {
  forward_gate gate({{mavlink::attitude::message_id, 250}});
  EXPECT_NEAR(passing<mavlink::attitude>(gate, 50), 40, 5);
  EXPECT_GT(gate.held_back(), 400U);
}

// A vehicle that is asked for five in a second sends five.
TEST(forward_gate, a_stream_of_any_higher_rate_passes_at_the_rate_that_is_promised_within_5_percent) {
  for (const int hz : {5, 6, 7, 9, 10, 13, 20, 30, 50}) {
    forward_gate gate({{mavlink::attitude::message_id, 250}});
    EXPECT_NEAR(passing<mavlink::attitude>(gate, hz), 40, 2) << hz;
  }
}

TEST(forward_gate, a_stream_that_was_silent_makes_up_for_nothing) {
  forward_gate gate({{mavlink::attitude::message_id, 250}});
  EXPECT_TRUE(gate.take(mavlink::attitude{}, 0));
  EXPECT_TRUE(gate.take(mavlink::attitude{}, 60'000 * ms));
  EXPECT_FALSE(gate.take(mavlink::attitude{}, 60'100 * ms));
  EXPECT_TRUE(gate.take(mavlink::attitude{}, 60'250 * ms));
}

TEST(forward_gate, a_stream_at_just_its_interval_passes_whole) {
  forward_gate gate({{mavlink::attitude::message_id, 250}});
  EXPECT_EQ(passing<mavlink::attitude>(gate, 4), 40);
}

TEST(forward_gate, a_message_without_an_interval_passes_as_it_comes) {
  forward_gate gate(default_rates());
  EXPECT_EQ(passing<mavlink::statustext>(gate, 50), 500);
}

TEST(forward_gate, heartbeats_always_pass) {
  forward_gate gate({{mavlink::heartbeat::message_id, 10'000}});
  EXPECT_EQ(passing<mavlink::heartbeat>(gate, 1), 10);
  EXPECT_FALSE(gate.set_interval(mavlink::heartbeat::message_id, -1));
}

TEST(forward_gate, the_newest_is_remembered_though_it_did_not_pass) {
  forward_gate gate({{mavlink::attitude::message_id, -1}});
  EXPECT_FALSE(gate.newest(mavlink::attitude::message_id));
  EXPECT_FALSE(gate.take(mavlink::attitude{.roll = 2}, 0));
  ASSERT_TRUE(gate.newest(mavlink::attitude::message_id));
  EXPECT_EQ(std::get<mavlink::attitude>(*gate.newest(mavlink::attitude::message_id)).roll, 2.0F);
}

TEST(forward_gate, an_interval_is_set_stopped_and_set_back) {
  forward_gate gate({{mavlink::attitude::message_id, 250}});
  EXPECT_TRUE(gate.set_interval(mavlink::attitude::message_id, 20'000));
  EXPECT_EQ(passing<mavlink::attitude>(gate, 50), 500);
  EXPECT_TRUE(gate.set_interval(mavlink::attitude::message_id, -1));
  EXPECT_EQ(passing<mavlink::attitude>(gate, 50), 0);
  EXPECT_TRUE(gate.set_interval(mavlink::attitude::message_id, 0));
  EXPECT_TRUE(gate.take(mavlink::attitude{}, 60'000 * ms));
  EXPECT_FALSE(gate.take(mavlink::attitude{}, 60'100 * ms));
}

TEST(forward_gate, what_is_not_forwarded_has_no_interval) {
  forward_gate gate({});
  EXPECT_FALSE(gate.set_interval(mavlink::command_ack::message_id, 1'000));
  EXPECT_FALSE(gate.set_interval(99'999, 1'000));
  EXPECT_FALSE(gate.set_interval(mavlink::attitude::message_id, -2));
  EXPECT_FALSE(gate.set_interval(mavlink::attitude::message_id, std::numeric_limits<std::int64_t>::max()));
}

} // namespace forward_gate_test
} // namespace godwit::ground_port
