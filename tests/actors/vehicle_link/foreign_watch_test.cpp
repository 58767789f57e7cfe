#include "actors/vehicle_link/foreign_watch.hpp"

#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/scanner.hpp"

namespace godwit::vehicle_link {
namespace foreign_watch_test {

namespace mavlink = io::mavlink;
using mavlink::mav_cmd;
using mavlink::mav_result;
using mavlink::number;

constexpr std::int64_t s = 1'000'000'000;

mavlink::command_ack ack(mav_cmd command, mav_result result, std::uint8_t system = 255) {
  mavlink::command_ack m;
  m.command = number(command);
  m.result = number(result);
  m.target_system = system;
  m.target_component = system == 0 ? 0 : 190;
  return m;
}

template <class M>
std::optional<foreign_act> on_frame(foreign_watch& watch, const M& message) {
  std::optional<foreign_act> result;
  mavlink::scanner one;
  one.feed(mavlink::encode(message, {255, 190}, 0).span(),
           [&](const mavlink::frame_view& frame) { result = watch.on_frame(frame, 1, s); });
  return result;
}

TEST(foreign_watch, what_the_vehicle_accepts_from_somebody_else_is_an_act) {
  foreign_watch watch;
  const auto seen = watch.on_ack(ack(mav_cmd::component_arm_disarm, mav_result::accepted), false, s);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->kind, foreign_kind::command);
  EXPECT_EQ(seen->system, 255);
  EXPECT_EQ(seen->command, 400);
}

TEST(foreign_watch, what_it_refuses_or_what_is_ours_is_none) {
  foreign_watch watch;
  EXPECT_FALSE(watch.on_ack(ack(mav_cmd::component_arm_disarm, mav_result::denied), false, s));
  EXPECT_FALSE(watch.on_ack(ack(mav_cmd::component_arm_disarm, mav_result::accepted), true, s));
}

TEST(foreign_watch, what_takes_nothing_is_none) {
  foreign_watch watch;
  EXPECT_FALSE(watch.on_ack(ack(mav_cmd::request_message, mav_result::accepted), false, s));
  EXPECT_FALSE(watch.on_ack(ack(mav_cmd::set_message_interval, mav_result::accepted), false, s));
}

// The port judges the answer to what it has let pass.
TEST(foreign_watch, what_the_port_has_forwarded_is_none) {
  foreign_watch watch;
  relayed_frame forwarded;
  forwarded.message = mavlink::command_long::message_id;
  forwarded.system = 255;
  forwarded.component = 190;
  forwarded.payload.assign(33, 0);
  forwarded.payload[28] = 400 & 0xFF;
  forwarded.payload[29] = 400 >> 8;
  watch.on_forwarded(forwarded, s);
  EXPECT_FALSE(watch.on_ack(ack(mav_cmd::component_arm_disarm, mav_result::accepted), false, 2 * s));
  EXPECT_TRUE(watch.on_ack(ack(mav_cmd::component_arm_disarm, mav_result::accepted, 254), false, 2 * s));
  EXPECT_TRUE(watch.on_ack(ack(mav_cmd::component_arm_disarm, mav_result::accepted), false,
                           s + foreign_watch::forwarded_counts_ns + 1));
}

TEST(foreign_watch, a_plan_of_somebody_else_is_seen_as_it_begins) {
  foreign_watch watch;
  mavlink::mission_count count;
  count.target_system = 1;
  count.count = 7;
  ASSERT_TRUE(on_frame(watch, count));
  EXPECT_EQ(on_frame(watch, count)->kind, foreign_kind::plan);
  count.mission_type = number(mavlink::mav_mission_type::fence);
  EXPECT_FALSE(on_frame(watch, count)) << "a fence is no plan";
  count.mission_type = 0;
  count.target_system = 2;
  EXPECT_FALSE(on_frame(watch, count)) << "for another vehicle";
}

TEST(foreign_watch, each_act_has_a_time_of_its_own) {
  foreign_watch watch;
  const auto first = watch.on_plan_answer(255, 190, s);
  EXPECT_GT(watch.on_plan_answer(255, 190, s)->at_ns, first->at_ns);
}

} // namespace foreign_watch_test
} // namespace godwit::vehicle_link
