// What people are told: what PX4 and ArduPilot were seen to say, and our own sentences.
#include "actors/ground_port/mission_server/server.hpp"

#include <gtest/gtest.h>

#include "tests/actors/ground_port/mission_server/plan_types.hpp"
#include "tests/actors/ground_port/mission_server/server_fixture.hpp"

namespace godwit::ground_port::mission_server::test {
namespace server_texts_test {

using mavlink::mav_mission_result;
using words = dialogue::words;

TEST(server_texts, ardupilot_says_that_a_plan_came_and_that_none_did) {
  dialogue with(ardupilot_copter_profile());
  (void)with.upload(3);
  EXPECT_EQ(with.texts(), words{"Flight plan received"});
  (void)with.tell(count_of(0));
  EXPECT_EQ(with.texts(), words{"Flight plan received"}) << "a count of 0 is a plan too";
  (void)with.tell(clear_of(0));
  EXPECT_EQ(with.texts(), words());
  (void)with.upload(1, fence);
  (void)with.tell(clear_of(fence));
  EXPECT_EQ(with.texts(), words(2, "Fence Indexed OK"));
  (void)with.tell(count_of(60'000));
  EXPECT_EQ(with.texts(), words{"Only 655 items are supported"});
  (void)with.tell(count_of(3));
  (void)with.wait(8 * s);
  EXPECT_EQ(with.texts(), words{"Mission upload timeout"});
}

TEST(server_texts, ardupilot_complains_of_the_deprecated_forms_once_in_each_life) {
  dialogue with(ardupilot_copter_profile());
  const auto use_both = [&] {
    (void)with.upload(2);
    (void)with.texts();
    for (int i = 0; i < 2; ++i)
      (void)with.tell(request_for<mavlink::mission_request>(1));
    (void)with.tell(mavlink::mission_item{});
    (void)with.tell(mavlink::mission_item{});
    return with.texts();
  };
  const words complaints{"got MISSION_REQUEST; use MISSION_REQUEST_INT!",
                         "got MISSION_ITEM; GCS should send MISSION_ITEM_INT"};
  EXPECT_EQ(use_both(), complaints);
  EXPECT_EQ(use_both(), words());
  with.vehicle().restart();
  EXPECT_EQ(use_both(), complaints);
}

TEST(server_texts, px4_says_nothing_of_what_goes_well) {
  dialogue with(px4_profile());
  (void)with.upload(3);
  (void)with.tell(count_of(0));
  EXPECT_EQ(with.texts(), words());
  (void)with.tell(list_of(0));
  (void)with.tell(count_of(2));
  (void)with.tell(waypoint(0));
  EXPECT_EQ(with.texts(), (words{"WPM: IGN MISSION_COUNT: Busy\t", "IGN MISSION_ITEM: Busy\t"}));
  (void)with.wait(5 * s);
  EXPECT_EQ(with.texts(), words{"Operation timeout\t"});
  (void)with.tell(waypoint(0));
  EXPECT_EQ(with.texts(), words{"IGN MISSION_ITEM: No transfer\t"});
  (void)with.tell(count_of(2));
  (void)with.tell(count_of(2), other_station);
  EXPECT_EQ(with.texts(), words()) << "refused without a word";
  (void)with.wait(5 * s);
  EXPECT_EQ(with.texts(), words{"Operation timeout\t"});
}

TEST(server_texts, our_own_name_who_what_and_why) {
  dialogue with(plain_profile());
  (void)with.upload(3);
  EXPECT_EQ(with.texts(), words{"Mission: 3 items taken from 255/190"});
  (void)with.tell(count_of(2));
  (void)with.tell(count_of(2), other_station);
  (void)with.tell(list_of(0), other_station);
  EXPECT_EQ(with.texts(),
            (words{"254/190 is refused: 255/190 is uploading", "254/190 is refused: 255/190 has a transfer"}));
  auto bad = waypoint(0);
  bad.x = 950'000'000;
  (void)with.tell(bad);
  EXPECT_EQ(with.texts(), words{"Mission: item 0: invalid param5 x"});
  (void)with.tell(count_of(2));
  (void)with.tell(waypoint(0));
  (void)with.wait(5 * s);
  EXPECT_EQ(with.texts(), words{"Mission: no item 1 from 255/190, given up"});
  (void)with.tell(count_of(2));
  (void)with.tell(ack_of(mav_mission_result::operation_cancelled));
  EXPECT_EQ(with.texts(), words{"Mission: upload cancelled by 255/190"});
  (void)with.tell(count_of(2'000));
  EXPECT_EQ(with.texts(), words{"Mission: 2000 items, room for 1000 only"});
  with.vehicle().lock(true);
  (void)with.tell(clear_of(0));
  with.vehicle().lock(false);
  (void)with.tell(clear_of(all));
  EXPECT_EQ(with.texts(), (words{"Mission: not cleared, it is being flown", "All plans: cleared by 255/190"}));
}

} // namespace server_texts_test
} // namespace godwit::ground_port::mission_server::test
