#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace position_test {

using namespace test;

using io::mavlink::gps_fix_type;

result with(gps_fix_type fix) {
  auto seen = good_facts();
  seen.vehicle.fix = fix;
  return check_position(seen, {});
}

TEST(position_check, passes_with_each_fix_in_three_dimensions) {
  for (const auto fix :
       {gps_fix_type::fix_3d, gps_fix_type::dgps, gps_fix_type::rtk_float, gps_fix_type::rtk_fixed, gps_fix_type::ppp})
    EXPECT_EQ(with(fix).how, verdict::pass);
}

TEST(position_check, passes_when_the_receiver_does_not_count_satellites) {
  auto seen = good_facts();
  seen.vehicle.satellites.reset();
  EXPECT_EQ(check_position(seen, {}).how, verdict::pass);
}

TEST(position_check, degrades_with_few_satellites_and_says_the_same_however_few) {
  auto seen = good_facts();
  seen.vehicle.satellites = 6;
  EXPECT_EQ(check_position(seen, {}).how, verdict::pass);
  seen.vehicle.satellites = 5;
  const auto found = check_position(seen, {});
  EXPECT_EQ(found.how, verdict::degraded);
  EXPECT_TRUE(has(found.sentence, "Fewer than 6")) << found.sentence;
  seen.vehicle.satellites = 4;
  EXPECT_EQ(check_position(seen, {}), found);
}

TEST(position_check, fails_without_a_fix_in_three_dimensions) {
  for (const auto fix : {gps_fix_type::no_gps, gps_fix_type::no_fix, gps_fix_type::fix_2d, gps_fix_type::fixed_position,
                         static_cast<gps_fix_type>(200)})
    EXPECT_EQ(with(fix).how, verdict::fail);
}

TEST(position_check, fails_when_the_position_is_old_or_was_never_heard) {
  auto seen = good_facts();
  seen.vehicle.position_age_ns = 2 * ns_per_s;
  EXPECT_EQ(check_position(seen, {}).how, verdict::pass);
  seen.vehicle.position_age_ns = 2 * ns_per_s + 1;
  EXPECT_EQ(check_position(seen, {}).how, verdict::fail);
  seen.vehicle.position_age_ns.reset();
  EXPECT_EQ(check_position(seen, {}).how, verdict::fail);
}

TEST(position_check, is_skipped_while_the_vehicle_is_not_heard) {
  auto seen = good_facts();
  seen.vehicle.link = vehicle_link::connection_phase::lost;
  EXPECT_EQ(check_position(seen, {}).how, verdict::skipped);
}

} // namespace position_test
} // namespace godwit::executor::preflight
