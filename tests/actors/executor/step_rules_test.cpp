#include "actors/executor/tasks/step_rules.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

#include "actors/domain/control_authority/mode_tables.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages/position.hpp"

namespace godwit::executor {
namespace step_rules_test {

using flight::mode_kind;
using io::mavlink::mav_autopilot;
using io::mavlink::mav_cmd;
using io::mavlink::number;

constexpr std::int64_t s = 1'000'000'000;

// A copter, and a task with one step that was sent so often.
struct scene {
  explicit scene(mode_kind mode = mode_kind::hold, bool is_armed = false,
                 mav_autopilot autopilot = mav_autopilot::px4) {
    beat.autopilot = number(autopilot);
    beat.type = number(io::mavlink::mav_type::quadrotor);
    const flight::mode_owner owner{autopilot, flight::vehicle_class::multirotor};
    beat.custom_mode = flight::modes_obeying(owner, mode).front();
    beat.base_mode = is_armed ? number(io::mavlink::mav_mode_flag::safety_armed) : 0;
    hear();
    authority.begin(*view.mode());
  }
  void hear() { view.take(beat, s); }
  void show_item(std::uint16_t sequence, std::int64_t at_ns) {
    io::mavlink::mission_current shown;
    shown.seq = sequence;
    view.take(shown, at_ns);
  }
  void send(bool was_accepted = false) {
    ++attempts.tries;
    attempts.sent_ns = 10 * s;
    attempts.sent_at_heartbeat = view.heartbeats();
    attempts.was_accepted = was_accepted;
  }
  [[nodiscard]] step_context as(task_kind kind) const { return {durable, view, authority, kind, attempts}; }

  io::mavlink::heartbeat beat;
  state durable;
  vehicle_view view;
  flight::control_authority authority;
  step_attempts attempts;
};

const step any_item = set_current_item{3};
const step mission_mode = change_mode{mode_kind::mission};
const std::vector<step> all{mission_mode,  safe_ground_mode{}, await_arming{}, guard{},        clear_plan{},
                            upload_plan{}, any_item,           restore_home{}, confirm_home{}, reset_home{},
                            arm{},         disarm{},           start_plan{}};

// -- effects ----------------------------------------------------------------------------------------

step_effect on_ground(const step& what) { return effect_of(what, scene().as(task_kind::start)); }

TEST(step_effect, of_a_mode_follows_from_where_it_leads) {
  EXPECT_EQ(on_ground(mission_mode), step_effect::flies_plan);
  EXPECT_EQ(on_ground(change_mode{mode_kind::guided}), step_effect::moves);
  EXPECT_EQ(on_ground(change_mode{mode_kind::returning}), step_effect::moves);
  EXPECT_EQ(on_ground(change_mode{mode_kind::hold}), step_effect::neutral);
  EXPECT_EQ(on_ground(await_arming{}), step_effect::flies_plan) << "somebody arms it next";
}

TEST(step_effect, arm_and_start_fly_the_plan_and_what_prepares_them_is_neutral) {
  EXPECT_EQ(on_ground(arm{}), step_effect::flies_plan);
  EXPECT_EQ(on_ground(start_plan{}), step_effect::flies_plan);
  for (const step& each :
       {step(guard{}), step(clear_plan{}), step(restore_home{}), step(confirm_home{}), step(reset_home{})})
    EXPECT_EQ(on_ground(each), step_effect::neutral) << description_of(each);
}

// Somebody else may have it by then: seen on a real vehicle, which was disarmed under a person's hands.
TEST(step_effect, a_disarm_needs_an_observation_and_is_not_for_what_moves) {
  EXPECT_EQ(on_ground(disarm{}), step_effect::moves);
  const scene flying(mode_kind::mission, true);
  EXPECT_NE(why_not_now(disarm{}, flying.as(task_kind::stand_down)), "");
}

TEST(step_effect, a_plan_or_item_moves_only_an_armed_vehicle_in_mission_mode) {
  scene flying(mode_kind::mission, true);
  flying.durable.status.in_flight = true;
  EXPECT_EQ(effect_of(upload_plan{}, flying.as(task_kind::deploy)), step_effect::moves);
  EXPECT_EQ(effect_of(any_item, flying.as(task_kind::resume)), step_effect::flies_plan);
  for (const auto& other : {scene(mode_kind::mission, false), scene(mode_kind::hold, true)}) {
    EXPECT_EQ(effect_of(upload_plan{}, other.as(task_kind::deploy)), step_effect::neutral);
    EXPECT_EQ(effect_of(any_item, other.as(task_kind::resume)), step_effect::neutral);
  }
}

TEST(step_effect, of_a_task_that_holds_or_returns_is_to_stop) {
  EXPECT_EQ(effect_of(change_mode{mode_kind::hold}, scene().as(task_kind::hold)), step_effect::stops);
  EXPECT_EQ(effect_of(change_mode{mode_kind::returning}, scene().as(task_kind::come_home)), step_effect::stops);
  const auto by_plan = scene().as(task_kind::come_home_by_plan);
  EXPECT_EQ(effect_of(change_mode{mode_kind::hold}, by_plan), step_effect::stops);
  EXPECT_EQ(effect_of(mission_mode, by_plan), step_effect::flies_plan);
  EXPECT_EQ(effect_of(safe_ground_mode{}, scene().as(task_kind::deploy)), step_effect::stops);
}

TEST(step_urgency, only_stops_and_disarming_do_not_wait_for_the_disk) {
  const step hold = change_mode{mode_kind::hold};
  const std::set<task_kind> at_once{task_kind::hold, task_kind::come_home, task_kind::stand_down};
  for (const auto kind : {task_kind::deploy, task_kind::start, task_kind::hold, task_kind::resume, task_kind::come_home,
                          task_kind::stand_down, task_kind::stand_by, task_kind::await_arming, task_kind::free_home})
    EXPECT_EQ(urgency_of(kind, &hold) == goes::at_once, at_once.contains(kind)) << io::name_of(kind);
  const step disarming = disarm{};
  EXPECT_FALSE(is_stop(task_kind::stand_down, &disarming)) << "it is not sent again as soon as it seems lost";
}

// -- when one may begin -----------------------------------------------------------------------------

std::set<std::string> refused(const scene& where, task_kind kind) {
  std::set<std::string> result;
  for (const auto& each : all)
    if (!why_not_now(each, where.as(kind)).empty())
      result.insert(description_of(each));
  return result;
}

// Nobody knows here who armed it: a disarm of it may be against a person.
TEST(step_begin, an_armed_vehicle_is_left_as_it_is_on_the_ground) {
  const std::set<std::string> expected{description_of(safe_ground_mode{}), description_of(await_arming{}),
                                       description_of(clear_plan{}), description_of(disarm{})};
  EXPECT_EQ(refused(scene(mode_kind::hold, true), task_kind::deploy), expected);
  EXPECT_EQ(why_not_now(safe_ground_mode{true}, scene(mode_kind::hold, true).as(task_kind::stand_by)), "");
}

TEST(step_begin, a_disarmed_vehicle_is_neither_started_nor_sent_on) {
  const std::set<std::string> at_start{description_of(start_plan{}), description_of(disarm{})};
  EXPECT_EQ(refused(scene(), task_kind::start), at_start);
  const std::set<std::string> expected{description_of(start_plan{}), description_of(mission_mode),
                                       description_of(disarm{})};
  EXPECT_EQ(refused(scene(), task_kind::resume), expected);
}

TEST(step_begin, a_vehicle_disarmed_in_its_flight_gets_no_plan_and_no_item) {
  scene where;
  for (const bool in_flight : {false, true}) {
    where.durable.status.in_flight = in_flight;
    const auto c = where.as(task_kind::deploy);
    EXPECT_EQ(!why_not_now(upload_plan{}, c).empty(), in_flight);
    EXPECT_EQ(!why_not_now(any_item, c).empty(), in_flight);
  }
}

// -- what is sent -----------------------------------------------------------------------------------

std::uint16_t command_of(const step& what, const step_context& c) {
  const auto sent = request_of(what, c);
  return sent ? std::get<vehicle_link::send_command>(sent->what).command : std::uint16_t{0};
}

TEST(step_request, each_order_that_changes_the_mode_names_the_modes_that_obey_it) {
  const scene where;
  const auto c = where.as(task_kind::start);
  const auto& owner = where.view.owner();
  EXPECT_EQ(request_of(mission_mode, c)->modes, flight::modes_obeying(owner, mode_kind::mission));
  EXPECT_EQ(request_of(await_arming{}, c)->modes, flight::modes_obeying(owner, mode_kind::mission));
  EXPECT_EQ(request_of(start_plan{}, c)->modes, flight::modes_of_start(owner));
  EXPECT_EQ(request_of(safe_ground_mode{}, c)->modes, std::vector{*flight::standing_mode(owner)});
  for (const step& each : {step(arm{}), step(disarm{}), step(guard{}), step(clear_plan{}), any_item})
    EXPECT_FALSE(request_of(each, c)->modes) << description_of(each);
}

TEST(step_request, a_px4_is_started_by_its_mode_and_others_by_mission_start) {
  const scene px4;
  const scene other(mode_kind::hold, false, mav_autopilot::ardupilotmega);
  EXPECT_EQ(command_of(start_plan{4}, px4.as(task_kind::start)), command_of(mission_mode, px4.as(task_kind::start)));
  EXPECT_EQ(command_of(start_plan{4}, other.as(task_kind::start)), number(mav_cmd::mission_start));
}

TEST(step_request, a_home_that_is_not_known_is_not_restored) {
  scene where;
  EXPECT_FALSE(request_of(restore_home{}, where.as(task_kind::start)));
  where.durable.home = kept_home{};
  EXPECT_EQ(command_of(restore_home{}, where.as(task_kind::start)), number(mav_cmd::do_set_home));
  EXPECT_EQ(command_of(reset_home{}, where.as(task_kind::start)), number(mav_cmd::do_set_home));
  EXPECT_EQ(command_of(confirm_home{}, where.as(task_kind::start)), number(mav_cmd::request_message));
}

TEST(step_request, an_item_is_set_anew_as_the_first_one) {
  const auto set = [](const set_current_item& what) {
    const auto sent = request_of(what, scene().as(task_kind::resume));
    return std::get<vehicle_link::set_current_item>(sent->what).sequence;
  };
  EXPECT_EQ(set({3, 9, false}), 3);
  EXPECT_EQ(set({3, 9, true}), 0);
}

// -- when one is done -------------------------------------------------------------------------------

TEST(step_done, before_it_is_sent_only_what_the_vehicle_shows_already) {
  const scene flying(mode_kind::mission, true);
  EXPECT_TRUE(is_done(mission_mode, flying.as(task_kind::resume)));
  EXPECT_TRUE(is_done(arm{}, flying.as(task_kind::start)));
  for (const step& each : {step(start_plan{}), any_item, step(guard{}), step(restore_home{}), step(confirm_home{}),
                           step(upload_plan{}), step(disarm{})})
    EXPECT_FALSE(is_done(each, flying.as(task_kind::start))) << description_of(each);
}

TEST(step_done, a_mode_that_was_sent_for_needs_a_newer_heartbeat) {
  scene where(mode_kind::mission, true);
  where.attempts.must_ask = true;
  EXPECT_FALSE(is_done(mission_mode, where.as(task_kind::resume))) << "it may be older than an order given up";
  where.send();
  EXPECT_FALSE(is_done(mission_mode, where.as(task_kind::resume)));
  where.hear();
  EXPECT_TRUE(is_done(mission_mode, where.as(task_kind::resume)));
}

TEST(step_done, an_item_is_current_when_the_vehicle_reports_it_afterwards) {
  scene where(mode_kind::hold, true);
  where.show_item(3, 9 * s);
  where.send();
  EXPECT_FALSE(is_done(any_item, where.as(task_kind::resume))) << "it was current before";
  where.show_item(2, 11 * s);
  EXPECT_FALSE(is_done(any_item, where.as(task_kind::resume)));
  where.show_item(4, 12 * s);
  EXPECT_TRUE(is_done(any_item, where.as(task_kind::resume))) << "item 3 is a command that moves nothing";
}

TEST(step_done, an_item_in_mission_mode_by_the_answer_alone) {
  EXPECT_TRUE(is_done_by_answer(any_item, scene(mode_kind::mission, true).as(task_kind::resume)));
  EXPECT_FALSE(is_done_by_answer(any_item, scene(mode_kind::hold, true).as(task_kind::resume)));
}

TEST(step_done, a_start_in_mission_mode_needs_an_answer_or_a_mission_that_runs) {
  scene where(mode_kind::mission, true);
  where.send();
  EXPECT_TRUE(is_done(start_plan{}, where.as(task_kind::start))) << "it was in another mode before";
  where.attempts.was_in_mission = true;
  EXPECT_FALSE(is_done(start_plan{}, where.as(task_kind::start)));
  where.attempts.was_accepted = true;
  EXPECT_TRUE(is_done(start_plan{}, where.as(task_kind::start)));
}

TEST(step_done, home_is_confirmed_by_a_report_after_the_request) {
  scene where;
  where.durable.home = kept_home{};
  where.view.take(io::mavlink::home_position{}, 9 * s);
  where.send(true);
  EXPECT_FALSE(is_done(confirm_home{}, where.as(task_kind::start)));
  EXPECT_TRUE(is_done(restore_home{}, where.as(task_kind::start))) << "its answer counts";
  where.view.take(io::mavlink::home_position{}, 11 * s);
  EXPECT_TRUE(is_done(confirm_home{}, where.as(task_kind::start)));
}

TEST(step_intent, only_uploads_items_and_starts_have_one) {
  for (const auto& each : all) {
    const auto is_start = std::holds_alternative<start_plan>(each) || std::holds_alternative<set_current_item>(each);
    const auto expected = is_start                                    ? step_intent::start
                          : std::holds_alternative<upload_plan>(each) ? step_intent::upload
                                                                      : step_intent::none;
    EXPECT_EQ(intent_of(each), expected) << description_of(each);
  }
}

} // namespace step_rules_test
} // namespace godwit::executor
