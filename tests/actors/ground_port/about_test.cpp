#include "actors/ground_port/about.hpp"

#include <gtest/gtest.h>

namespace godwit::ground_port {
namespace about_test {

constexpr std::uint64_t set_attitude_target = 128;
constexpr std::uint64_t mission_int = 4;

TEST(about, versions_are_the_vehicles_and_capabilities_are_the_ports) {
  const auto shown = version_to_show(
      mavlink::autopilot_version{.capabilities = set_attitude_target, .flight_sw_version = 9, .uid = 7});
  EXPECT_EQ(shown.flight_sw_version, 9U);
  EXPECT_EQ(shown.uid, 7U);
  EXPECT_EQ(shown.capabilities & set_attitude_target, 0U);
  EXPECT_EQ(shown.capabilities & mission_int, mission_int);
  EXPECT_EQ(version_to_show(std::nullopt).capabilities, shown.capabilities);
}

TEST(about, only_version_2_of_the_protocol_is_spoken) {
  EXPECT_EQ(protocol_to_show().min_version, 200);
  EXPECT_EQ(protocol_to_show().max_version, 200);
}

TEST(about, parameters_tell_the_ids_under_the_names_of_both_autopilots) {
  const vehicle_role::param_table table(params_to_show({3, 191}));
  EXPECT_EQ(table.value_of("MAV_SYS_ID"), 3.0F);
  EXPECT_EQ(table.value_of("SYSID_THISMAV"), 3.0F);
  EXPECT_EQ(table.value_of("MAV_COMP_ID"), 191.0F);
}

} // namespace about_test
} // namespace godwit::ground_port
