// What the flying side is told of a plan: that it is being replaced, has been, or is gone; and what was there before a
// start is put back without a word.
#include "actors/ground_port/mission_server/server.hpp"

#include <gtest/gtest.h>

#include "tests/actors/ground_port/mission_server/server_fixture.hpp"

namespace godwit::ground_port::mission_server::test {
namespace server_changes_test {

using words = dialogue::words;

constexpr int fence = 1;
constexpr int rally = 2;
constexpr int all = 255;

std::vector<plan_change_kind> kinds(const dialogue& with) {
  std::vector<plan_change_kind> result;
  for (const auto& each : with.changes())
    result.push_back(each.kind);
  return result;
}

TEST(server_changes, ardupilots_mission_is_cut_at_the_count_and_an_atomic_one_is_flown_on) {
  using enum plan_change_kind;
  dialogue ardupilot(ardupilot_copter_profile());
  (void)ardupilot.upload(4);
  (void)ardupilot.tell(count_of(2));
  EXPECT_EQ(kinds(ardupilot), (std::vector{begun_replacing, replaced, begun_replacing}));
  EXPECT_EQ(ardupilot.changes().back().count, 2) << "what is left of the old one";
  dialogue px4(px4_profile());
  (void)px4.upload(4);
  (void)px4.tell(count_of(2));
  EXPECT_EQ(kinds(px4), std::vector{replaced});
  dialogue fences(ardupilot_copter_profile());
  (void)fences.upload(2, fence);
  EXPECT_EQ(kinds(fences), std::vector{replaced}) << "its fence is replaced as a whole";
}

TEST(server_changes, clearing_is_told_for_each_type) {
  dialogue with(plain_profile());
  (void)with.upload(2);
  (void)with.tell(clear_of(all));
  ASSERT_EQ(with.changes().size(), 4U);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(with.changes()[i].kind, plan_change_kind::cleared);
    EXPECT_EQ(with.changes()[i].count, 0);
  }
}

TEST(server_changes, the_mark_of_the_current_item_is_told_for_a_mission_alone) {
  for (const auto& vehicle : {px4_profile(), ardupilot_copter_profile(), plain_profile()}) {
    dialogue with(vehicle);
    (void)with.upload(3);
    EXPECT_EQ(with.changes().back().marked_current, std::nullopt);
    for (const int type : {0, rally}) {
      (void)with.tell(count_of(3, type));
      for (int seq = 0; seq < 3; ++seq) {
        auto item = waypoint(seq, type);
        item.current = seq == 1 ? 1 : 0;
        (void)with.tell(item);
      }
      EXPECT_EQ(with.changes().back().marked_current, type == 0 ? std::optional(1) : std::nullopt);
    }
  }
}

TEST(server_changes, the_same_plan_again_is_identical_whatever_is_marked) {
  for (const auto& vehicle : {px4_profile(), plain_profile()}) {
    dialogue with(vehicle);
    (void)with.upload(3);
    EXPECT_FALSE(with.changes().back().identical);
    const auto id = with.held().id;
    (void)with.tell(count_of(3));
    for (int seq = 0; seq < 3; ++seq) {
      auto item = waypoint(seq);
      item.current = seq == 2 ? 1 : 0;
      (void)with.tell(item);
    }
    EXPECT_TRUE(with.changes().back().identical);
    EXPECT_EQ(with.changes().back().marked_current, 2);
    EXPECT_EQ(with.held().id, id);
    (void)with.upload(2);
    EXPECT_FALSE(with.changes().back().identical);
  }
}

TEST(server_changes, a_plan_of_an_earlier_life_is_put_back_as_it_was_and_without_a_word) {
  for (const auto& vehicle : {px4_profile(), plain_profile(), ardupilot_rover_profile()}) {
    dialogue before(vehicle);
    (void)before.upload(3);
    (void)before.upload(2, fence);
    server after(vehicle, vehicle_id);
    for (const auto type : {mavlink::mav_mission_type::mission, mavlink::mav_mission_type::fence}) {
      after.put_plan(type, before.vehicle().plan(type).items);
      EXPECT_EQ(after.plan(type).id, before.vehicle().plan(type).id);
      EXPECT_EQ(after.plan(type).items.size(), before.vehicle().plan(type).items.size());
    }
    const auto nothing = after.on_time(1 * s);
    EXPECT_TRUE(nothing.messages.empty() && nothing.changes.empty() && nothing.texts.empty());
    EXPECT_TRUE(after.is_idle());
  }
}

TEST(server_changes, the_partner_is_who_has_a_transfer) {
  dialogue with(plain_profile());
  EXPECT_EQ(with.vehicle().partner(), std::nullopt);
  (void)with.tell(count_of(2));
  EXPECT_EQ(with.vehicle().partner(), station);
  (void)with.tell(ack_of(mavlink::mav_mission_result::operation_cancelled));
  (void)with.tell(list_of(0), other_station);
  EXPECT_EQ(with.vehicle().partner(), other_station);
}

} // namespace server_changes_test
} // namespace godwit::ground_port::mission_server::test
