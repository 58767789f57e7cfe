#include "io/mavlink/signing/replay_table.hpp"

#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/io/mavlink/signing/signing_fixture.hpp"

namespace godwit::io::mavlink::test {
namespace replay_table_test {

constexpr signing_time now = signing_time_at(some_day_ns);
constexpr signed_stream vehicle{{1, 1}, link_id{0}};

constexpr signed_stream numbered(std::uint8_t system) { return {{system, 1}, link_id{0}}; }

// All places taken, each with TIME.
replay_table full_table(signing_time time) {
  replay_table table;
  for (std::uint8_t system = 1; system <= max_signed_streams; ++system)
    EXPECT_EQ(table.take(numbered(system), time, time), verdict::accepted_signed);
  return table;
}

TEST(mavlink_replay_table, a_timestamp_must_be_above_the_last_of_its_stream) {
  replay_table table;
  EXPECT_EQ(table.take(vehicle, now, now), verdict::accepted_signed);
  EXPECT_EQ(table.take(vehicle, now, now), verdict::replayed);
  EXPECT_EQ(table.take(vehicle, earlier(now, 1), now), verdict::replayed);
  EXPECT_EQ(table.take(vehicle, later(now, 1), now), verdict::accepted_signed);
}

TEST(mavlink_replay_table, a_known_stream_may_lag_as_far_as_it_likes) {
  replay_table table;
  ASSERT_EQ(table.take(vehicle, now, now), verdict::accepted_signed);
  EXPECT_EQ(table.take(vehicle, later(now, 1), later(now, 1000 * max_behind)), verdict::accepted_signed);
}

TEST(mavlink_replay_table, a_stream_is_system_component_and_link) {
  replay_table table;
  for (const auto& stream : {vehicle, signed_stream{{2, 1}, link_id{0}}, signed_stream{{1, 2}, link_id{0}},
                             signed_stream{{1, 1}, link_id{1}}})
    EXPECT_EQ(table.take(stream, now, now), verdict::accepted_signed);
  EXPECT_EQ(table.streams(), 4U);
}

TEST(mavlink_replay_table, a_new_stream_may_be_60_s_behind_and_no_more) {
  replay_table table;
  EXPECT_EQ(table.take(vehicle, earlier(now, max_behind + 1), now), verdict::too_old);
  EXPECT_EQ(table.streams(), 0U);
  EXPECT_EQ(table.take(vehicle, earlier(now, max_behind), now), verdict::accepted_signed);
}

TEST(mavlink_replay_table, new_and_known_streams_may_be_10_min_ahead_and_no_more) {
  replay_table table;
  EXPECT_EQ(table.take(vehicle, later(now, max_ahead + 1), now), verdict::too_new);
  EXPECT_EQ(table.take(vehicle, later(now, max_ahead), now), verdict::accepted_signed);
  EXPECT_EQ(table.take(vehicle, later(now, max_ahead + 1), now), verdict::too_new);
  EXPECT_EQ(table.take(vehicle, later(now, max_ahead + 1), later(now, 1)), verdict::accepted_signed);
}

TEST(mavlink_replay_table, a_frame_from_the_future_shuts_nobody_else_out) {
  replay_table table;
  ASSERT_EQ(table.take(numbered(9), later(now, max_ahead), now), verdict::accepted_signed);
  EXPECT_EQ(table.take(vehicle, earlier(now, max_behind), now), verdict::accepted_signed);
}

TEST(mavlink_replay_table, a_refused_timestamp_is_not_remembered) {
  replay_table table;
  ASSERT_EQ(table.take(vehicle, now, now), verdict::accepted_signed);
  ASSERT_EQ(table.take(vehicle, later(now, max_ahead + 9), now), verdict::too_new);
  EXPECT_EQ(table.take(vehicle, later(now, 1), now), verdict::accepted_signed);
}

TEST(mavlink_replay_table, a_seventeenth_stream_is_refused_while_all_others_speak) {
  replay_table table = full_table(now);
  EXPECT_EQ(table.take(numbered(17), now, now), verdict::too_many_streams);
  EXPECT_EQ(table.take(numbered(17), later(now, max_behind), later(now, max_behind)), verdict::too_many_streams);
  EXPECT_EQ(table.take(numbered(1), later(now, 1), now), verdict::accepted_signed); // the known ones go on
  EXPECT_EQ(table.streams(), max_signed_streams);
}

TEST(mavlink_replay_table, a_stream_silent_for_more_than_60_s_gives_its_place_to_a_new_one) {
  replay_table table = full_table(now);
  const signing_time after = later(now, max_behind + 1);
  ASSERT_EQ(table.take(numbered(2), after, after), verdict::accepted_signed); // so not this one
  EXPECT_EQ(table.take(numbered(17), after, after), verdict::accepted_signed);
  EXPECT_EQ(table.streams_forgotten(), 1U);
  EXPECT_EQ(table.streams(), max_signed_streams);
  EXPECT_EQ(table.take(numbered(2), after, after), verdict::replayed);
}

TEST(mavlink_replay_table, frames_of_a_forgotten_stream_are_not_taken_again) {
  replay_table table = full_table(now);
  const signing_time after = later(now, max_behind + 1);
  for (std::uint8_t system = 101; system <= 116; ++system)
    ASSERT_EQ(table.take(numbered(system), after, after), verdict::accepted_signed);
  EXPECT_EQ(table.take(numbered(1), now, after), verdict::too_old);
  EXPECT_EQ(table.take(numbered(1), now, now), verdict::replayed); // although our clock was set back
  EXPECT_EQ(table.streams_forgotten(), max_signed_streams);
}

// Whatever arrives in whatever order, and however our clock is set: nothing is accepted twice.
RC_GTEST_PROP(mavlink_replay_table_property, no_frame_is_accepted_twice, ()) {
  const auto steps = *rc::gen::container<std::vector<std::tuple<int, int, int>>>(
      rc::gen::tuple(rc::gen::inRange(0, 24), rc::gen::inRange(0, 400), rc::gen::inRange(0, 400)));
  replay_table table;
  std::set<std::pair<int, signing_time>> accepted;
  for (const auto& [system, time_s, now_s] : steps) {
    const signing_time time = later(now, static_cast<std::uint64_t>(time_s) * signing_units_per_s);
    const signing_time clock = later(now, static_cast<std::uint64_t>(now_s) * signing_units_per_s);
    if (table.take(numbered(static_cast<std::uint8_t>(system)), time, clock) == verdict::accepted_signed)
      RC_ASSERT(accepted.emplace(system, time).second);
    RC_ASSERT(table.streams() <= max_signed_streams);
  }
  RC_CLASSIFY(table.streams_forgotten() > 0);
}

} // namespace replay_table_test
} // namespace godwit::io::mavlink::test
