#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "io/mavlink/messages.hpp"
#include "io/mavlink/signing/verifier.hpp"
#include "tests/io/mavlink/signing/signing_fixture.hpp"

namespace godwit::io::mavlink::test {

namespace verifier_test {

constexpr signing_time now = signing_time_at(some_day_ns);

frame_buffer unsigned_radio_status() { return encode(radio_status{}, sender{51, 68}, 0); }

TEST(mavlink_verifier, a_link_without_a_key_is_trusted_and_signatures_are_not_looked_at) {
  verifier in;
  EXPECT_FALSE(in.has_key());
  EXPECT_EQ(in.judge(golden_heartbeat(signing::off).view(), now), verdict::accepted_unsigned);
  EXPECT_EQ(in.judge(heartbeat_at(now).view(), now), verdict::accepted_unsigned);
  EXPECT_EQ(in.judge(heartbeat_at(now).view(), now), verdict::accepted_unsigned);
}

TEST(mavlink_verifier, a_link_with_a_key_refuses_what_is_unsigned_but_for_its_short_list) {
  replay_table streams;
  verifier in(counting_key(), streams);
  EXPECT_TRUE(in.has_key());
  EXPECT_EQ(in.judge(golden_heartbeat(signing::off).view(), now), verdict::unsigned_refused);
  EXPECT_EQ(in.judge(unsigned_radio_status().view(), now), verdict::accepted_unsigned);
  EXPECT_EQ(in.judge(heartbeat_at(now).view(), now), verdict::accepted_signed);
}

TEST(mavlink_verifier, where_unsigned_frames_are_accepted_wrong_signatures_still_are_not) {
  replay_table streams;
  verifier in(counting_key(1), streams, unsigned_policy::accept_all());
  EXPECT_EQ(in.judge(golden_heartbeat(signing::off).view(), now), verdict::accepted_unsigned);
  EXPECT_EQ(in.judge(heartbeat_at(now).view(), now), verdict::bad_signature);
}

TEST(mavlink_verifier, the_short_list_does_not_excuse_a_wrong_signature) {
  replay_table streams;
  verifier in(counting_key(1), streams);
  const auto frame = signed_at(encode(radio_status{}, sender{51, 68}, 0, signing::on), now);
  EXPECT_EQ(in.judge(frame.view(), now), verdict::bad_signature);
}

TEST(mavlink_verifier, the_signature_is_judged_before_the_time) {
  replay_table streams;
  verifier wrong(counting_key(1), streams);
  EXPECT_EQ(wrong.judge(heartbeat_at(signing_time{1}).view(), now), verdict::bad_signature);
  EXPECT_EQ(wrong.judge(heartbeat_at(later(now, 2 * max_ahead)).view(), now), verdict::bad_signature);
  verifier right(counting_key(), streams);
  EXPECT_EQ(right.judge(heartbeat_at(signing_time{1}).view(), now), verdict::too_old);
  EXPECT_EQ(right.judge(heartbeat_at(later(now, 2 * max_ahead)).view(), now), verdict::too_new);
}

TEST(mavlink_verifier, a_wrong_signature_touches_no_stream) {
  replay_table streams;
  verifier in(counting_key(1), streams);
  for (std::uint8_t system = 0; system < 100; ++system)
    EXPECT_EQ(in.judge(heartbeat_at(now, system).view(), now), verdict::bad_signature);
  EXPECT_EQ(streams.streams(), 0U);
}

TEST(mavlink_verifier, a_frame_recorded_on_one_link_is_not_taken_on_another_with_the_same_key) {
  replay_table streams;
  verifier radio(counting_key(), streams);
  verifier modem(counting_key(), streams);
  const auto frame = heartbeat_at(now);
  EXPECT_EQ(radio.judge(frame.view(), now), verdict::accepted_signed);
  EXPECT_EQ(modem.judge(frame.view(), now), verdict::replayed);
}

TEST(mavlink_verifier, counts_each_verdict) {
  replay_table streams;
  verifier in(counting_key(), streams);
  for (std::uint8_t system = 1; system <= max_signed_streams; ++system)
    ASSERT_EQ(in.judge(heartbeat_at(now, system).view(), now), verdict::accepted_signed);
  EXPECT_EQ(in.judge(heartbeat_at(now, 77).view(), now), verdict::too_many_streams);
  EXPECT_EQ(in.judge(heartbeat_at(now, 1).view(), now), verdict::replayed);
  EXPECT_EQ(in.judge(golden_heartbeat(signing::off).view(), now), verdict::unsigned_refused);
  EXPECT_EQ(in.judge(unsigned_radio_status().view(), now), verdict::accepted_unsigned);
  EXPECT_EQ(in.counts().of(verdict::accepted_signed), max_signed_streams);
  EXPECT_EQ(in.counts().of(verdict::too_many_streams), 1U);
  EXPECT_EQ(in.counts().of(verdict::replayed), 1U);
  EXPECT_EQ(in.counts().of(verdict::unsigned_refused), 1U);
  EXPECT_EQ(in.counts().of(verdict::bad_signature), 0U);
  EXPECT_EQ(in.counts().rejected(), 3U);
  EXPECT_EQ(in.counts().total(), max_signed_streams + 4);
}

TEST(mavlink_verifier, each_verdict_has_a_name_and_its_own_counter) {
  std::size_t place = 0;
  for (const auto& [each, name] : enum_names(verdict{})) {
    EXPECT_EQ(static_cast<std::size_t>(each), place++) << name;
    EXPECT_EQ(io::value_of<verdict>(name), each);
  }
}

} // namespace verifier_test

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
