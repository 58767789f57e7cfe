#include "actors/vehicle_link/transfer/plan_reader.hpp"
#include "tests/support/time_units.hpp"

#include <gtest/gtest.h>

namespace godwit::vehicle_link::transfer {
namespace plan_reader_test {

using mavlink::mav_autopilot;
using mavlink::mav_mission_result;

using godwit::tests::ms;
constexpr parties who{{1, 191}, {1, 1}, mavlink::mav_mission_type::mission};

class plan_reader_test : public ::testing::Test {
protected:
  static mavlink::mission_count count_of(std::uint16_t count, std::uint32_t id = 0) {
    mavlink::mission_count result;
    result.count = count;
    result.opaque_id = id;
    return result;
  }
  static mavlink::mission_item_int item(std::uint16_t seq) {
    mavlink::mission_item_int result;
    result.seq = seq;
    return result;
  }
  static mavlink::mission_ack ack_of(mav_mission_result result) {
    mavlink::mission_ack ack;
    ack.type = mavlink::number(result);
    return ack;
  }
  // Lets time pass until the reader has ended.
  static std::int64_t run_out(plan_reader& reader) {
    std::int64_t now_ns = 0;
    for (int i = 0; i < 1'000 && !reader.is_over(); ++i) {
      step out;
      now_ns = reader.next_deadline_ns();
      reader.on_time(out, now_ns);
    }
    return now_ns;
  }

  round_trip line;
  step out;
};

TEST_F(plan_reader_test, the_count_alone_is_enough_where_only_that_is_asked) {
  plan_reader reader(plan_reader::depth::count, who, profile_for(mav_autopilot::px4), line);
  reader.start(out, ms);
  ASSERT_TRUE(std::holds_alternative<mavlink::mission_request_list>(out.messages.at(0)));
  reader.on_count(out, count_of(12, 99), 31 * ms);
  EXPECT_EQ(reader.now(), plan_reader::state::complete);
  EXPECT_EQ(reader.count(), 12);
  EXPECT_EQ(reader.plan_id(), 99U);
  EXPECT_EQ(out.messages.size(), 1U);
}

TEST_F(plan_reader_test, items_may_come_in_any_order_and_twice) {
  plan_reader reader(plan_reader::depth::items, who, profile_for(mav_autopilot::ardupilotmega), line);
  reader.start(out, ms);
  reader.on_count(out, count_of(3), 31 * ms);
  for (const int seq : {2, 0, 0, 2, 1})
    reader.on_item(out, item(static_cast<std::uint16_t>(seq)), 61 * ms);
  EXPECT_EQ(reader.now(), plan_reader::state::complete);
  EXPECT_EQ(reader.received(), 3);
}

TEST_F(plan_reader_test, items_that_were_not_asked_for_are_ignored) {
  plan_reader reader(plan_reader::depth::items, who, profile_for(mav_autopilot::px4), line);
  reader.on_item(out, item(0), ms);
  reader.start(out, ms);
  reader.on_count(out, count_of(3), 31 * ms);
  reader.on_item(out, item(2), 40 * ms);
  reader.on_item(out, item(60'000), 40 * ms);
  EXPECT_EQ(reader.received(), 0);
}

TEST_F(plan_reader_test, the_longest_plan_that_can_be_counted_is_asked_for_within_the_window) {
  plan_reader reader(plan_reader::depth::items, who, profile_for(mav_autopilot::ardupilotmega), line);
  reader.start(out, ms);
  reader.on_count(out, count_of(65'535), 31 * ms);
  EXPECT_LE(out.messages.size(), 33U);
}

TEST_F(plan_reader_test, silence_ends_when_the_vehicle_must_have_given_up) {
  const auto px4 = profile_for(mav_autopilot::px4);
  plan_reader reader(plan_reader::depth::count, who, px4, line);
  reader.start(out, 0);
  EXPECT_GE(run_out(reader), px4.patience_ns);
  EXPECT_EQ(reader.now(), plan_reader::state::silent);
  EXPECT_GE(reader.requests_sent(), static_cast<std::uint32_t>(min_tries));
  EXPECT_LE(reader.requests_sent(), 20U);
}

TEST_F(plan_reader_test, a_refusal_is_believed_when_nothing_follows) {
  plan_reader reader(plan_reader::depth::count, who, profile_for(mav_autopilot::px4), line);
  reader.start(out, ms);
  reader.on_ack(ack_of(mav_mission_result::unsupported));
  EXPECT_FALSE(reader.is_over());
  run_out(reader);
  EXPECT_EQ(reader.now(), plan_reader::state::refused);
  EXPECT_EQ(reader.refusal(), mavlink::number(mav_mission_result::unsupported));
}

TEST_F(plan_reader_test, a_late_refusal_of_something_else_does_not_count) {
  plan_reader reader(plan_reader::depth::count, who, profile_for(mav_autopilot::px4), line);
  reader.start(out, ms);
  reader.on_ack(ack_of(mav_mission_result::unsupported));
  reader.on_count(out, count_of(1), 31 * ms);
  EXPECT_EQ(reader.now(), plan_reader::state::complete);
}

TEST_F(plan_reader_test, a_vehicle_that_is_busy_is_asked_for_longer_than_its_patience) {
  const auto px4 = profile_for(mav_autopilot::px4);
  plan_reader reader(plan_reader::depth::count, who, px4, line);
  reader.start(out, 0);
  reader.on_ack(ack_of(mav_mission_result::error));
  EXPECT_GE(run_out(reader), patience_with_busy * px4.patience_ns);
  EXPECT_EQ(reader.now(), plan_reader::state::refused);
}

TEST_F(plan_reader_test, begins_again_when_no_item_comes_and_not_for_ever) {
  plan_reader reader(plan_reader::depth::items, who, profile_for(mav_autopilot::px4), line);
  reader.start(out, 0);
  int lists = 1;
  std::int64_t now_ns = 0;
  reader.on_count(out, count_of(3), now_ns);
  for (int i = 0; i < 1'000 && !reader.is_over(); ++i) {
    step each;
    now_ns = reader.next_deadline_ns();
    reader.on_time(each, now_ns);
    if (!each.messages.empty() && std::holds_alternative<mavlink::mission_request_list>(each.messages.front())) {
      ++lists;
      reader.on_count(each, count_of(3), now_ns);
    }
  }
  EXPECT_EQ(lists, plan_reader::max_listings);
  EXPECT_EQ(reader.now(), plan_reader::state::silent);
}

} // namespace plan_reader_test
} // namespace godwit::vehicle_link::transfer
