#include "programs/godwit-drill/flight_simulation/people_audit.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "io/mavlink/enums.hpp"
#include "programs/godwit-drill/flight_simulation/simulated_person.hpp"
#include "programs/godwit-drill/flight_simulation/simulated_station.hpp"

namespace godwit::drill {
namespace people_audit_test {

namespace mavlink = io::mavlink;
using mavlink::mav_cmd;
using mavlink::number;

constexpr std::int64_t ms = 1'000'000;
constexpr std::int64_t s = 1'000 * ms;
constexpr mavlink::sender godwit_id{1, 191};
constexpr mavlink::sender vehicle_id{1, 1};
constexpr std::uint32_t loiter = 0x0304'0000;
constexpr std::uint32_t mission = 0x0404'0000;
constexpr std::uint32_t position_control = 0x0003'0000;

// A PX4 that is what it is told to be.
struct audited_px4 {
  void become(const std::string& mode, bool is_armed, bool is_in_air = false) {
    seen.mode = mode;
    seen.armed = is_armed;
    seen.in_air = is_in_air;
  }
  template <class M>
  void godwit_sends(const M& what) {
    audit.on_sent(mavlink::encode(what, godwit_id, 0).view(), now_ns);
  }
  void godwit_commands(mav_cmd what, float param1 = 0, float param2 = 0, float param3 = 0) {
    godwit_sends(command_of(what, param1, param2, param3));
  }
  static mavlink::command_long command_of(mav_cmd what, float param1 = 0, float param2 = 0, float param3 = 0) {
    return {.target_system = 1,
            .target_component = 1,
            .command = number(what),
            .param1 = param1,
            .param2 = param2,
            .param3 = param3};
  }
  // What a person's frame makes of it.
  void person_makes(const std::string& mode, bool is_armed, const mavlink::command_long& by) {
    const auto before = seen;
    become(mode, is_armed, before.in_air);
    audit.on_handled(mavlink::encode(by, {254, 190}, 0).view(), true, before, seen, now_ns);
  }
  // An order of godwit's, which changes nothing.
  void godwits_is_handled(const mavlink::command_long& what) {
    audit.on_handled(mavlink::encode(what, godwit_id, 0).view(), false, seen, seen, now_ns);
  }
  void answer_to_person_comes(std::uint16_t command) {
    audit.on_delivered(
        mavlink::encode(mavlink::command_ack{.command = command, .target_system = 254, .target_component = 190},
                        vehicle_id, 0)
            .view(),
        now_ns);
  }
  void accepts(mav_cmd what) {
    audit.on_answered(mavlink::encode(mavlink::command_ack{.command = number(what),
                                                           .target_system = godwit_id.system,
                                                           .target_component = godwit_id.component},
                                      vehicle_id, 0)
                          .view(),
                      now_ns);
  }
  void heartbeat_comes(std::uint32_t custom_mode) {
    const auto armed = number(mavlink::mav_mode_flag::safety_armed);
    audit.on_delivered(
        mavlink::encode(mavlink::heartbeat{.base_mode = static_cast<std::uint8_t>(seen.armed ? armed | 1 : 1),
                                           .custom_mode = custom_mode},
                        vehicle_id, 0)
            .view(),
        now_ns);
  }
  template <class M>
  void station_sends(const M& what) {
    audit.on_station_sent(mavlink::encode(what, simulated_station::self, 0).view(), now_ns);
  }
  void station_is_answered(mav_cmd what, mavlink::mav_result result) {
    audit.on_station_heard(
        mavlink::encode(mavlink::command_ack{.command = number(what), .result = number(result), .target_system = 255},
                        vehicle_id, 0)
            .view(),
        now_ns);
  }
  void wait(std::int64_t ns) {
    now_ns += ns;
    audit.on_time(now_ns);
  }
  [[nodiscard]] std::size_t found(const std::string& word) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        audit.findings(), [&](const std::string& each) { return each.find(word) != std::string::npos; }));
  }

  std::int64_t now_ns = 10 * s;
  sim::vehicle_picture seen;
  people_audit audit{sim::personality::px4, [this] { return seen; }};
};

const auto disarm = audited_px4::command_of(mav_cmd::component_arm_disarm, 0);
const auto to_position_control = audited_px4::command_of(mav_cmd::do_set_mode, 1, 3);

// -- taken ------------------------------------------------------------------------------------------

TEST(people_audit, finds_an_arm_after_a_person_has_disarmed_and_a_heartbeat_could_show_it) {
  audited_px4 world;
  world.become("AUTO.LOITER", true);
  world.person_makes("AUTO.LOITER", false, disarm);
  world.wait(1 * s);
  world.godwit_commands(mav_cmd::component_arm_disarm, 1);
  EXPECT_EQ(world.found("taken"), 0U) << "nobody can know of it";
  world.wait(1 * s);
  world.godwit_commands(mav_cmd::component_arm_disarm, 1);
  EXPECT_EQ(world.found("taken: ARM was sent 2.00 s after a person's disarm"), 1U);
}

TEST(people_audit, finds_it_sooner_where_a_heartbeat_has_shown_it) {
  audited_px4 world;
  world.become("AUTO.LOITER", true);
  world.person_makes("AUTO.LOITER", false, disarm);
  world.wait(200 * ms);
  world.heartbeat_comes(loiter);
  world.wait(200 * ms);
  world.godwit_commands(mav_cmd::mission_start);
  EXPECT_EQ(world.found("taken"), 0U) << "it was on its way";
  world.wait(200 * ms);
  world.godwit_commands(mav_cmd::mission_start);
  EXPECT_EQ(world.found("taken: MISSION_START was sent 0.60 s after"), 1U);
}

TEST(people_audit, finds_each_order_that_moves_the_vehicle_and_none_that_stops_it) {
  const auto moves = [](const auto& order) {
    audited_px4 world;
    world.become("AUTO.MISSION", true, true);
    world.person_makes("POSCTL", true, to_position_control);
    world.wait(3 * s);
    world.godwit_sends(order);
    return world.found("taken") == 1;
  };
  const auto command = [](mav_cmd what, float param1 = 0, float param2 = 0, float param3 = 0) {
    return audited_px4::command_of(what, param1, param2, param3);
  };
  EXPECT_TRUE(moves(command(mav_cmd::do_set_mode, 1, 4, 4)));
  EXPECT_TRUE(moves(command(mav_cmd::do_set_mode, 129, 4, 4)));
  EXPECT_TRUE(moves(mavlink::set_mode{1, 1, mission}));
  EXPECT_TRUE(moves(command(mav_cmd::nav_takeoff)));
  EXPECT_TRUE(moves(command(mav_cmd::do_reposition)));
  EXPECT_TRUE(moves(mavlink::mission_set_current{1, 1, 2}));
  EXPECT_FALSE(moves(command(mav_cmd::do_set_mode, 1, 4, 3))) << "hold";
  EXPECT_FALSE(moves(command(mav_cmd::do_set_mode, 1, 4, 5))) << "return";
  EXPECT_FALSE(moves(command(mav_cmd::component_arm_disarm, 0)));
  EXPECT_FALSE(moves(command(mav_cmd::request_message, 0)));
}

TEST(people_audit, a_word_of_an_operator_gives_the_vehicle_back) {
  audited_px4 world;
  world.become("AUTO.MISSION", true, true);
  world.person_makes("POSCTL", true, to_position_control);
  world.wait(3 * s);
  world.audit.on_release();
  world.godwit_commands(mav_cmd::do_set_mode, 1, 4, 4);
  EXPECT_TRUE(world.audit.findings().empty());
}

TEST(people_audit, an_act_that_was_overridden_before_it_could_be_known_is_over) {
  audited_px4 world;
  world.become("AUTO.LOITER", true, true);
  world.person_makes("POSCTL", true, to_position_control);
  const auto before = world.seen;
  world.become("AUTO.MISSION", true, true);
  world.audit.on_handled(mavlink::encode(to_position_control, godwit_id, 0).view(), false, before, world.seen,
                         world.now_ns);
  world.wait(5 * s);
  world.godwit_commands(mav_cmd::do_set_mode, 1, 4, 4);
  EXPECT_TRUE(world.audit.findings().empty());
}

const auto to_mission = audited_px4::command_of(mav_cmd::do_set_mode, 1, 4, 4);

TEST(people_audit, a_mode_that_godwit_asks_for_in_the_same_moment_is_nobodys_where_no_answer_is_heard) {
  audited_px4 world;
  world.become("AUTO.LOITER", true);
  world.person_makes("AUTO.MISSION", true, to_mission);
  world.godwits_is_handled(to_mission);
  world.heartbeat_comes(mission);
  world.wait(2 * s);
  world.godwit_commands(mav_cmd::mission_start);
  EXPECT_EQ(world.found("taken"), 0U);
}

TEST(people_audit, a_mode_that_godwit_asks_for_in_the_same_moment_is_the_persons_from_the_answer_to_them_on) {
  for (const auto command : {number(mav_cmd::do_set_mode), std::uint16_t{mavlink::set_mode::message_id}}) {
    audited_px4 world;
    world.become("AUTO.LOITER", true);
    world.person_makes("AUTO.MISSION", true, to_mission);
    world.godwits_is_handled(to_mission);
    world.answer_to_person_comes(command);
    world.wait(200 * ms);
    world.godwit_commands(mav_cmd::mission_start);
    EXPECT_EQ(world.found("taken"), 0U) << "it was on its way";
    world.wait(200 * ms);
    world.godwit_commands(mav_cmd::mission_start);
    EXPECT_EQ(world.found("taken: MISSION_START was sent 0.40 s after"), 1U) << command;
  }
}

TEST(people_audit, the_same_mode_that_godwit_asks_for_after_it_was_shown_is_the_persons) {
  audited_px4 world;
  world.become("AUTO.LOITER", true);
  world.person_makes("AUTO.MISSION", true, to_mission);
  world.heartbeat_comes(mission);
  world.wait(1 * s);
  world.godwits_is_handled(to_mission);
  world.godwit_commands(mav_cmd::mission_start);
  EXPECT_EQ(world.found("taken"), 1U);
}

TEST(people_audit, another_mode_than_the_one_that_godwit_asks_for_in_the_same_moment_is_the_persons) {
  audited_px4 world;
  world.become("AUTO.LOITER", true);
  world.godwits_is_handled(to_mission);
  world.person_makes("POSCTL", true, to_position_control);
  world.wait(2 * s);
  world.godwit_commands(mav_cmd::mission_start);
  EXPECT_EQ(world.found("taken"), 1U);
}

TEST(people_audit, finds_an_order_after_the_answer_to_a_person_has_come_to_godwit) {
  audited_px4 world;
  world.become("AUTO.LOITER", true);
  world.person_makes("POSCTL", true, to_position_control);
  world.answer_to_person_comes(number(mav_cmd::do_set_mode));
  world.wait(400 * ms);
  world.godwit_commands(mav_cmd::do_set_mode, 1, 4, 4);
  EXPECT_EQ(world.found("taken: the mission mode was sent 0.40 s after"), 1U);
}

// -- foreign ----------------------------------------------------------------------------------------

TEST(people_audit, finds_a_start_with_a_plan_that_somebody_else_has_brought) {
  audited_px4 world;
  world.audit.on_foreign_plan(world.now_ns);
  world.wait(2 * s);
  world.godwit_commands(mav_cmd::do_set_mode, 1, 4, 4);
  EXPECT_EQ(world.found("foreign"), 0U) << "it was proved just before";
  world.wait(1 * s);
  world.godwit_commands(mav_cmd::mission_start);
  EXPECT_EQ(world.found("foreign"), 1U);
}

TEST(people_audit, a_plan_that_godwit_has_brought_since_is_its_own) {
  audited_px4 world;
  world.audit.on_foreign_plan(world.now_ns);
  world.wait(2 * s);
  world.audit.on_answered(
      mavlink::encode(mavlink::mission_ack{.target_system = 1, .target_component = 191}, vehicle_id, 0).view(),
      world.now_ns);
  world.wait(2 * s);
  world.godwit_commands(mav_cmd::mission_start);
  EXPECT_TRUE(world.audit.findings().empty());
}

// -- again ------------------------------------------------------------------------------------------

// A rover is stopped for another plan before it has moved, and started with that.
TEST(people_audit, what_an_operator_wants_since_is_another_order) {
  audited_px4 world;
  world.godwit_commands(mav_cmd::mission_start);
  world.accepts(mav_cmd::mission_start);
  world.audit.on_word();
  world.wait(100 * ms);
  world.accepts(mav_cmd::mission_start); // the second copy
  world.wait(2 * s);
  world.godwit_commands(mav_cmd::mission_start);
  EXPECT_EQ(world.found("again"), 0U);
}

TEST(people_audit, finds_an_order_that_is_sent_again_after_it_was_accepted) {
  for (const auto what : {mav_cmd::component_arm_disarm, mav_cmd::mission_start}) {
    audited_px4 world;
    world.godwit_commands(what, 1);
    world.wait(100 * ms);
    world.accepts(what);
    world.wait(100 * ms);
    world.godwit_commands(what, 1);
    EXPECT_EQ(world.found("again"), 0U) << "the acknowledgement was on its way";
    world.wait(3 * s);
    world.godwit_commands(what, 1);
    EXPECT_EQ(world.found("again"), 1U);
  }
}

TEST(people_audit, an_order_that_was_refused_or_that_a_person_asks_for_may_be_sent_again) {
  audited_px4 world;
  world.godwit_commands(mav_cmd::component_arm_disarm, 1);
  world.wait(3 * s);
  world.godwit_commands(mav_cmd::component_arm_disarm, 1);
  world.accepts(mav_cmd::component_arm_disarm);
  world.wait(3 * s);
  world.audit.on_release();
  world.godwit_commands(mav_cmd::component_arm_disarm, 1);
  EXPECT_TRUE(world.audit.findings().empty());
}

TEST(people_audit, the_acknowledgement_of_a_disarm_is_none_of_an_arm) {
  audited_px4 world;
  world.godwit_commands(mav_cmd::component_arm_disarm, 1);
  world.wait(1 * s);
  world.godwit_commands(mav_cmd::component_arm_disarm, 0);
  world.accepts(mav_cmd::component_arm_disarm);
  world.wait(3 * s);
  world.godwit_commands(mav_cmd::component_arm_disarm, 1);
  EXPECT_TRUE(world.audit.findings().empty());
}

// -- stations ---------------------------------------------------------------------------------------

TEST(people_audit, finds_an_acknowledgement_of_what_the_vehicle_does_not_do) {
  audited_px4 world;
  world.become("AUTO.MISSION", true, true);
  world.station_sends(audited_px4::command_of(mav_cmd::do_set_mode, 129, 4, 3));
  world.wait(10 * ms);
  world.station_is_answered(mav_cmd::do_set_mode, mavlink::mav_result::accepted);
  world.wait(3 * s);
  EXPECT_EQ(world.found("answer: a station received ACCEPTED for command 176"), 1U);
}

TEST(people_audit, an_acknowledgement_is_true_when_the_vehicle_has_done_it_in_time_or_nothing_was_promised) {
  audited_px4 world;
  world.become("AUTO.MISSION", true, true);
  world.station_sends(audited_px4::command_of(mav_cmd::do_set_mode, 129, 4, 3));
  world.station_is_answered(mav_cmd::do_set_mode, mavlink::mav_result::accepted);
  world.wait(500 * ms);
  world.become("AUTO.LOITER", true, true);
  world.wait(500 * ms);
  world.become("AUTO.MISSION", true, true);
  world.station_sends(audited_px4::command_of(mav_cmd::component_arm_disarm, 0));
  world.station_is_answered(mav_cmd::component_arm_disarm, mavlink::mav_result::temporarily_rejected);
  world.wait(10 * s);
  EXPECT_TRUE(world.audit.findings().empty());
}

// -- disarm -----------------------------------------------------------------------------------------

TEST(people_audit, finds_a_disarm_of_what_a_person_has_armed_unless_an_operator_lets_godwit_go_on) {
  const auto arm = audited_px4::command_of(mav_cmd::component_arm_disarm, 1);
  audited_px4 world;
  world.become("AUTO.LOITER", true);
  world.godwit_sends(disarm);
  EXPECT_EQ(world.found("disarm"), 0U) << "godwit has armed it";
  world.become("AUTO.LOITER", false);
  world.person_makes("AUTO.LOITER", true, arm);
  world.wait(1 * s);
  world.godwit_sends(disarm);
  EXPECT_EQ(world.found("disarm: DISARM was sent 1.00 s after"), 1U);
  world.become("AUTO.LOITER", false);
  world.person_makes("AUTO.LOITER", true, arm);
  world.audit.on_release();
  world.godwit_sends(disarm);
  EXPECT_EQ(world.found("disarm"), 1U);
}

TEST(people_audit, finds_a_mode_of_a_station_that_is_swallowed_in_flight) {
  audited_px4 world;
  world.become("AUTO.MISSION", true, true);
  world.station_sends(mavlink::set_mode{1, 157, position_control});
  world.wait(3 * s);
  EXPECT_EQ(world.found("swallowed: a station's SET_MODE to POSCTL"), 1U);
  const mavlink::set_mode once_more{1, 157, position_control};
  world.station_sends(once_more);
  world.audit.on_sent(mavlink::encode(once_more, simulated_station::self, 0).view(), world.now_ns);
  world.wait(3 * s);
  EXPECT_EQ(world.found("swallowed"), 1U) << "it was passed on, and lost on the line";
}

} // namespace people_audit_test
} // namespace godwit::drill
