// What other people do with their stations, on another line: uploads, modes, home, items; and what godwit's line shows.
//
// Sources: ArduPilot 4.7-dev, PX4 1.18, flights with both, and recordings of QGroundControl (base modes).
#include <array>

#include <gtest/gtest.h>

#include "io/mavlink/messages/heartbeat.hpp"
#include "programs/godwit-drill/flight_simulation/simulated_person.hpp"
#include "programs/godwit-sim/vehicle/autopilot/mode_table.hpp"
#include "tests/programs/godwit-sim/vehicle/vehicle_world.hpp"

namespace godwit::sim::test {
namespace other_people_test {

using drill::mode_form;
using drill::simulated_person;

constexpr std::array autopilots{personality::px4, personality::ardupilot, personality::plane};

// godwit's station flies the vehicle on line 0; the person is on another line.
struct visited_world : vehicle_world {
  explicit visited_world(personality vehicle_type)
      : vehicle_world(vehicle_type), who(vehicle_type),
        radio(subject().add_line([this](std::span<const std::byte> bytes) { person.receive(bytes); }, now_ns())),
        person({254, 190},
               [this](std::span<const std::byte> bytes) { send_frame(mavlink::frame_view(bytes.data()), radio); }) {
    person.send_heartbeat();
    run_for(7 * s);
  }

  // Into the air, on the way to its second waypoint.
  [[nodiscard]] bool fly() {
    return upload(flight_of(3, home(), who)) == mav_mission_result::accepted && make_ready() &&
           command(mav_cmd::mission_start) == mav_result::accepted &&
           run_until([&] { return picture().in_air && picture().mission_current == second_waypoint(); }, 120 * s);
  }
  [[nodiscard]] int second_waypoint() const { return who == personality::px4 ? 2 : 3; }
  // As many items, 60 m to the east of those that are flown.
  [[nodiscard]] plan foreign() const {
    auto result = flight_of(3, home(), who);
    for (auto& each : result)
      if (each.command == mavlink::number(mav_cmd::nav_waypoint))
        each.y += 8'000;
    return result;
  }
  [[nodiscard]] bool upload_foreign() {
    person.upload(foreign());
    return run_until(
        [&] {
          while (person.answer()) {
          }
          return person.plan_answer().has_value();
        },
        5 * s);
  }
  void act(const std::function<void()>& what) {
    mark();
    what();
    while (person.answer()) {
    }
  }

  personality who;
  vehicle::line_number radio;
  simulated_person person;
};

// AP_Mission keeps the item that is current; ModeAuto::run of Copter and Rover looks for changes and says so to all.
TEST(other_people, an_upload_of_the_same_length_is_flown_by_a_copter_under_way_and_it_says_so) {
  visited_world world(personality::ardupilot);
  ASSERT_TRUE(world.fly());
  world.mark();
  ASSERT_TRUE(world.upload_foreign());
  EXPECT_EQ(world.person.plan_answer(), mavlink::number(mav_mission_result::accepted));
  EXPECT_TRUE(world.said("Auto mission changed, restarted command", 0));
  EXPECT_TRUE(world.each<mavlink::mission_ack>(0).empty());
  EXPECT_EQ(world.picture().mode, "AUTO");
  EXPECT_EQ(world.picture().mission_current, 3);
  ASSERT_TRUE(world.run_until([&] { return world.picture().mission_current == 4; }, 60 * s));
  EXPECT_NEAR(between(world.picture().where, world.home()).distance_m, 67, 10) << "it was at the person's item";
}

// Plane has no AP_Mission_ChangeDetector.
TEST(other_people, an_upload_of_the_same_length_in_flight_shows_nowhere_on_a_plane) {
  visited_world world(personality::plane);
  ASSERT_TRUE(world.fly());
  world.mark();
  ASSERT_TRUE(world.upload_foreign());
  EXPECT_FALSE(world.said("Auto mission changed, restarted command"));
  EXPECT_FALSE(world.said("Flight plan received", 0));
  EXPECT_EQ(world.picture().mission_state, "running");
}

TEST(other_people, an_upload_of_the_same_length_on_the_ground_shows_nowhere_on_ardupilot) {
  for (const auto who : {personality::ardupilot, personality::plane}) {
    visited_world world(who);
    ASSERT_EQ(world.upload(flight_of(3, world.home(), who)), mav_mission_result::accepted);
    world.run_for(2 * s);
    const auto before = *world.last<mavlink::mission_current>();
    world.mark();
    ASSERT_TRUE(world.upload_foreign());
    world.run_for(2 * s);
    EXPECT_EQ(world.last<mavlink::mission_current>()->total, before.total);
    EXPECT_EQ(world.last<mavlink::mission_current>()->seq, before.seq);
    EXPECT_EQ(world.last<mavlink::mission_current>()->mission_id, 0U) << "it has no plan ids";
    EXPECT_TRUE(world.texts(0).empty());
  }
}

// PX4: mission_id of MISSION_CURRENT is the opaque_id of MISSION_ACK and of MISSION_COUNT in a download.
TEST(other_people, an_upload_gives_a_px4_another_plan_id_which_each_line_is_told) {
  visited_world world(personality::px4);
  ASSERT_EQ(world.upload(flight_of(3, world.home(), personality::px4)), mav_mission_result::accepted);
  world.run_for(2 * s);
  const auto ours = world.last<mavlink::mission_current>()->mission_id;
  ASSERT_NE(ours, 0U);
  ASSERT_TRUE(world.upload_foreign());
  world.run_for(2 * s);
  const auto theirs = world.last<mavlink::mission_current>()->mission_id;
  EXPECT_NE(theirs, ours);
  ASSERT_TRUE(world.download());
  EXPECT_EQ(world.last<mavlink::mission_count>()->opaque_id, theirs);
}

TEST(other_people, who_chooses_an_item_is_answered_on_their_line_and_the_vehicle_goes_there) {
  for (const auto who : autopilots) {
    visited_world world(who);
    ASSERT_TRUE(world.fly());
    const auto chosen = static_cast<std::uint16_t>(world.second_waypoint() + 1);
    world.act([&] { world.person.choose_item(chosen, who == personality::px4); });
    EXPECT_TRUE(world.each<mavlink::command_ack>(0).empty());
    EXPECT_EQ(world.picture().mission_current, chosen) << io::name_of(who);
    world.run_for(1'100 * ms);
    EXPECT_GE(world.last<mavlink::mission_current>()->seq, chosen) << "at the interval of its line";
  }
}

// AP_AHRS::set_home sends MSG_HOME to all; PX4 streams HOME_POSITION.
TEST(other_people, home_that_somebody_moves_is_told_on_each_line) {
  for (const auto who : autopilots) {
    visited_world world(who);
    ASSERT_TRUE(world.fly());
    const auto there = moved(world.home(), {90, 200});
    world.act([&] { world.person.set_home(there); });
    EXPECT_EQ(world.person.result_of(mav_cmd::do_set_home), mavlink::number(mav_result::accepted));
    world.run_for(2 * s);
    const auto told = world.each<mavlink::home_position>(0);
    ASSERT_FALSE(told.empty()) << io::name_of(who);
    EXPECT_NEAR(static_cast<double>(told.back().longitude) * 1e-7, there.longitude_deg, 1e-6);
  }
}

// Of the base mode both look at the custom bit alone: GCS_MAVLINK::_set_mode_common, and DO_SET_MODE in Commander.cpp.
TEST(other_people, a_mode_is_changed_whatever_else_its_base_mode_says) {
  for (const auto who : autopilots)
    for (const auto how : drill::all_mode_forms) {
      visited_world world(who);
      ASSERT_TRUE(world.fly());
      const auto modes = who == personality::px4         ? px4_modes()
                         : who == personality::ardupilot ? copter_modes()
                                                         : plane_modes();
      const auto& wanted = mode_of_kind(modes, mode_kind::come_back);
      world.act([&] { world.person.change_mode(who, wanted.custom, how); });
      EXPECT_EQ(world.picture().mode, wanted.name) << io::name_of(who) << ", " << io::name_of(how);
      EXPECT_TRUE(world.each<mavlink::command_ack>(0).empty());
    }
}

// PX4: handle_message_set_mode makes DO_SET_MODE of it. ArduPilot 4.7: handle_set_mode has no answer.
TEST(other_people, set_mode_is_acknowledged_by_a_px4_as_the_command) {
  visited_world world(personality::px4);
  ASSERT_TRUE(world.fly());
  world.act([&] { world.person.change_mode(world.who, px4_mode(4, 3), mode_form::set_mode_armed); });
  EXPECT_EQ(world.person.result_of(mav_cmd::do_set_mode), mavlink::number(mav_result::accepted));
  visited_world silent(personality::ardupilot);
  ASSERT_TRUE(silent.fly());
  silent.act([&] { silent.person.change_mode(silent.who, 5, mode_form::set_mode_armed); });
  EXPECT_EQ(silent.person.result_of(mav_cmd::do_set_mode), std::nullopt);
  EXPECT_EQ(silent.picture().mode, "LOITER");
}

// PX4: TRANSITION_DENIED is TEMPORARILY_REJECTED. ArduPilot: AP_Arming_Copter::disarm returns false, FAILED.
TEST(other_people, a_disarm_in_the_air_is_refused_and_shows_nowhere_unless_it_is_forced) {
  for (const auto who : {personality::px4, personality::ardupilot}) {
    visited_world world(who);
    ASSERT_TRUE(world.fly());
    world.act([&] { world.person.disarm(); });
    EXPECT_EQ(world.person.result_of(mav_cmd::component_arm_disarm),
              mavlink::number(who == personality::px4 ? mav_result::temporarily_rejected : mav_result::failed));
    EXPECT_TRUE(world.picture().armed);
    EXPECT_TRUE(world.each<mavlink::command_ack>(0).empty());
    world.act([&] { world.person.disarm(true); });
    EXPECT_FALSE(world.picture().armed);
  }
}

TEST(other_people, a_disarm_on_the_ground_shows_by_heartbeats_alone_on_the_line_of_others) {
  for (const auto who : autopilots) {
    visited_world world(who);
    world.beat(false);
    ASSERT_TRUE(world.make_ready());
    world.run_for(1'500 * ms);
    ASSERT_NE(world.last<mavlink::heartbeat>()->base_mode & 128U, 0U);
    world.act([&] { world.person.disarm(); });
    EXPECT_EQ(world.person.result_of(mav_cmd::component_arm_disarm), mavlink::number(mav_result::accepted));
    EXPECT_TRUE(world.each<mavlink::command_ack>(0).empty());
    EXPECT_TRUE(world.each<mavlink::heartbeat>(0).empty());
    world.run_for(1 * s);
    EXPECT_EQ(world.last<mavlink::heartbeat>()->base_mode & 128U, 0U) << io::name_of(who);
  }
}

} // namespace other_people_test
} // namespace godwit::sim::test
