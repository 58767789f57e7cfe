// The data of the personalities: traits, streams and parameters.
#include "programs/godwit-sim/vehicle/autopilot/traits.hpp"

#include <set>

#include <gtest/gtest.h>

#include "io/mavlink/messages/heartbeat.hpp"

namespace godwit::sim {
namespace traits_test {

constexpr std::array every_personality{personality::rover, personality::px4, personality::ardupilot,
                                       personality::plane};

TEST(traits, each_personality_starts_in_a_mode_that_it_has) {
  for (const auto who : every_personality)
    EXPECT_NE(find_mode(traits_of(who).modes, traits_of(who).first_mode), nullptr);
}

TEST(traits, each_streams_its_heartbeat_at_1_hz_and_each_message_once) {
  for (const auto who : every_personality) {
    std::set<std::uint32_t> ids;
    for (const auto& each : traits_of(who).streams) {
      EXPECT_TRUE(ids.insert(each.id).second) << each.id;
      EXPECT_TRUE(each.id != mavlink::heartbeat::message_id || each.interval_ns == ns_per_s);
    }
    EXPECT_TRUE(ids.contains(mavlink::heartbeat::message_id));
  }
}

TEST(traits, parameters_have_names_that_fit_and_are_sorted_out) {
  for (const auto who : every_personality) {
    std::set<std::string> names;
    for (const auto& each : traits_of(who).params) {
      EXPECT_LE(each.name.size(), 16U);
      EXPECT_TRUE(names.insert(each.name).second) << each.name;
    }
    EXPECT_GE(names.size(), 18U);
  }
}

TEST(traits, only_ardupilot_keeps_home_as_an_item) {
  for (const auto who : every_personality)
    EXPECT_EQ(traits_of(who).plan_profile.home.has_value(), who == personality::ardupilot || who == personality::plane);
}

} // namespace traits_test
} // namespace godwit::sim
