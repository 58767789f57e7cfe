#include "programs/godwit-eyes/session/pose_history.hpp"
#include "tests/support/time_units.hpp"

#include <gtest/gtest.h>

namespace pose_history_test {

using namespace godwit;
using namespace godwit::eyes;

using godwit::tests::ms;

io::eyes::pose pose_at(std::int64_t at_ns) {
  io::eyes::pose result;
  result.at_ns = at_ns;
  result.height_m = static_cast<double>(at_ns) / ms;
  return result;
}

TEST(pose_history, a_picture_finds_the_pose_that_is_nearest_in_time) {
  pose_history all;
  EXPECT_FALSE(all.at(0));
  for (std::int64_t at = 1000; at <= 2000; at += 100)
    all.add(pose_at(at * ms));
  EXPECT_EQ(all.at(1240 * ms)->at_ns, 1200 * ms);
  EXPECT_EQ(all.at(1260 * ms)->at_ns, 1300 * ms);
  EXPECT_EQ(all.at(900 * ms)->at_ns, 1000 * ms);
  EXPECT_EQ(all.at(2100 * ms)->at_ns, 2000 * ms);
  EXPECT_EQ(all.at(2100 * ms)->height_m, 2000);
}

TEST(pose_history, a_pose_of_another_time_is_none) {
  pose_history all;
  all.add(pose_at(0));
  EXPECT_TRUE(all.at(pose_history::max_age_ns));
  EXPECT_FALSE(all.at(pose_history::max_age_ns + 1));
  EXPECT_FALSE(all.at(-pose_history::max_age_ns - 1));
}

TEST(pose_history, what_is_not_newer_is_left_out_and_the_oldest_is_forgotten) {
  pose_history all;
  all.add(pose_at(100 * ms));
  all.add(pose_at(50 * ms));
  EXPECT_EQ(all.at(0)->at_ns, 100 * ms);
  for (std::int64_t i = 0; i < 1000; ++i)
    all.add(pose_at((200 + i) * ms));
  EXPECT_EQ(all.at(200 * ms)->at_ns, (1200 - static_cast<std::int64_t>(pose_history::max_poses)) * ms);
}

} // namespace pose_history_test
