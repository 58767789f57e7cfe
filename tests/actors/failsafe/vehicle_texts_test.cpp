#include <gtest/gtest.h>

#include "actors/failsafe/rules.hpp"
#include "actors/failsafe/vehicle_texts.hpp"
#include "io/mavlink/enums.hpp"

namespace vehicle_texts_test {

using namespace godwit;
using namespace godwit::failsafe;
namespace mavlink = io::mavlink;
using flight::vehicle_class;
using mavlink::mav_autopilot;
using mavlink::mav_cmd;

constexpr flight::mode_owner px4_rover{mav_autopilot::px4, vehicle_class::rover};
constexpr flight::mode_owner ardupilot_rover{mav_autopilot::ardupilotmega, vehicle_class::rover};

command_vehicle to(action what) { return {.number = 7, .why = rule::fence, .what = what, .confirmation = 3}; }

TEST(vehicle_words, return_land_and_the_landing_of_the_mission_are_commands_of_their_own) {
  const std::pair<action, mav_cmd> words[] = {{action::return_home, mav_cmd::nav_return_to_launch},
                                              {action::land, mav_cmd::nav_land},
                                              {action::do_land_start, mav_cmd::do_land_start}};
  for (const auto& [what, command] : words)
    for (const auto autopilot : {mav_autopilot::px4, mav_autopilot::ardupilotmega}) {
      const auto said = words_for(to(what), {autopilot, vehicle_class::multirotor});
      EXPECT_EQ(said.value().command, mavlink::number(command));
      EXPECT_EQ(said->confirmation, 3);
      EXPECT_FALSE(mode_words_for(to(what), {autopilot, vehicle_class::multirotor}));
    }
}

TEST(vehicle_words, hold_is_a_mode_of_each_autopilot) {
  const auto px4 = words_for(to(action::hold), px4_rover).value();
  EXPECT_EQ(px4.command, mavlink::number(mav_cmd::do_set_mode));
  EXPECT_EQ(px4.param2, 4);
  EXPECT_EQ(px4.param3, 3);
  const auto ardupilot = words_for(to(action::hold), ardupilot_rover).value();
  EXPECT_EQ(ardupilot.param2, 4);
  EXPECT_EQ(ardupilot.confirmation, 3);
}

TEST(vehicle_words, hold_can_be_said_without_waiting_for_an_answer) {
  EXPECT_EQ(mode_words_for(to(action::hold), px4_rover).value().custom_mode, 4U << 16U | 3U << 24U);
  const auto ardupilot = mode_words_for(to(action::hold), ardupilot_rover).value();
  EXPECT_EQ(ardupilot.custom_mode, 4U);
  EXPECT_EQ(ardupilot.base_mode, 1);
}

TEST(vehicle_words, each_is_obeyed_by_exact_modes) {
  using modes = std::vector<std::uint32_t>;
  constexpr flight::mode_owner copter{mav_autopilot::ardupilotmega, vehicle_class::multirotor};
  constexpr flight::mode_owner plane{mav_autopilot::ardupilotmega, vehicle_class::fixed_wing};
  EXPECT_EQ(modes_for(action::return_home, copter), modes{6});
  EXPECT_EQ(modes_for(action::land, copter), modes{9});
  EXPECT_EQ(modes_for(action::hold, copter), modes{17}); // BRAKE, and not LOITER
  EXPECT_EQ(modes_for(action::return_home, plane), (modes{11, 21, 20}));
  EXPECT_EQ(modes_for(action::do_land_start, plane), modes{10});
  EXPECT_EQ(modes_for(action::hold, ardupilot_rover), modes{4});
  EXPECT_EQ(modes_for(action::hold, px4_rover), modes{4U << 16U | 3U << 24U});
}

// For each class and each rule that can act on it.
TEST(vehicle_words, there_are_words_for_all_that_a_failsafe_wants_of_a_vehicle) {
  for (const auto vehicle : {vehicle_class::multirotor, vehicle_class::fixed_wing, vehicle_class::rover})
    for (const auto autopilot : {mav_autopilot::px4, mav_autopilot::ardupilotmega, mav_autopilot::generic})
      for (const auto each : rules)
        for (const bool has_land_start : {false, true}) {
          const auto what = action_for(each, vehicle, has_land_start).value();
          EXPECT_TRUE(words_for(to(what), {autopilot, vehicle}));
          EXPECT_FALSE(modes_for(what, {autopilot, vehicle}).empty());
        }
}

} // namespace vehicle_texts_test

namespace sentences_test {

using namespace godwit::failsafe;

TEST(sentences, each_rule_says_its_cause) {
  const battery_verdict level{.known = true, .percent = 14};
  const fence_verdict beyond{fence_finding::breached, breach{2}, {}};
  EXPECT_EQ(cause_of(rule::battery_critical, level, {}), "the battery is at 14 %");
  EXPECT_EQ(cause_of(rule::battery_low, level, {}), "the battery is at 14 %");
  EXPECT_EQ(cause_of(rule::fence, level, beyond), "a fence is breached: it is in geofence 3, which excludes it");
  EXPECT_EQ(cause_of(rule::operator_link, level, {}), "the operator's ground station is lost");
}

TEST(sentences, each_action_says_what_the_vehicle_does) {
  EXPECT_EQ(deed_of(action::return_home), "the vehicle returns");
  EXPECT_EQ(deed_of(action::land), "the vehicle lands");
  EXPECT_EQ(deed_of(action::hold), "the vehicle holds");
  EXPECT_EQ(deed_of(action::do_land_start), "the vehicle goes on at the landing of its mission");
}

} // namespace sentences_test
