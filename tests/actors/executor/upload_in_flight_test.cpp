// A station uploads a plan in flight: while its own flight is paused it takes the place of the one on the vehicle.
#include "tests/actors/executor/station_plans.hpp"

namespace godwit::executor {
namespace upload_in_flight_test {

using ground_port::plan_verdict;
using operators::command_kind;

class uploaded_in_flight : public testing::TestWithParam<sim::personality> {
protected:
  void SetUp() override {
    ASSERT_TRUE(bring(world, first));
    ASSERT_TRUE(fly_two_items(world, first));
  }
  [[nodiscard]] testing::AssertionResult pause() {
    if (!world.say(command_kind::pause).is_taken || !world.run_until([&] { return is_held(); }, 20))
      return testing::AssertionFailure() << world.story();
    world.run_for(3); // it stands
    return testing::AssertionSuccess();
  }
  [[nodiscard]] bool is_held() const {
    return world.durable().status.now == phase::paused && world.durable().status.cause == pause_cause::asked;
  }
  // What becomes of it in the end; none: nobody says so.
  [[nodiscard]] std::optional<plan_verdict> upload_and_wait(const upload& items, double most_s = 60) {
    const auto so_far = world.judged().size();
    world.station_says(taken(items));
    (void)world.run_until([&] { return final_verdict(so_far).has_value(); }, most_s);
    return final_verdict(so_far);
  }
  [[nodiscard]] std::optional<plan_verdict> final_verdict(std::size_t since) const {
    for (auto i = since; i < world.judged().size(); ++i)
      if (world.judged()[i].verdict != plan_verdict::bringing)
        return world.judged()[i].verdict;
    return std::nullopt;
  }
  [[nodiscard]] std::uint16_t first_waypoint() const { return GetParam() == sim::personality::rover ? 1 : 2; }
  // Somewhere else than the first, and longer.
  [[nodiscard]] upload second_plan() const {
    auto result = first;
    result[first_waypoint()] = waypoint_at(GetParam(), -40, 20);
    result.insert(result.begin() + first_waypoint() + 1, waypoint_at(GetParam(), -40, -40));
    return numbered(result);
  }
  [[nodiscard]] bool shows(const upload& items) const {
    return world.shown_progress().back().plan_id == io::mavlink::checksum_of(items);
  }

  flight_world world{by_stations(GetParam())};
  upload first = station_items(GetParam());
  upload second = second_plan();
};

// Found with MAVSDK: Success, and then "the plan is not taken: another one is flown".
TEST_P(uploaded_in_flight, the_plan_of_before_a_go_to_is_not_called_taken_while_that_is_flown) {
  ASSERT_TRUE(pause());
  operators::command go_to;
  go_to.kind = command_kind::go_to;
  go_to.place = mission::position{world.vehicle().describe().where.latitude_deg + 0.0002,
                                  world.vehicle().describe().where.longitude_deg, 20};
  ASSERT_TRUE(world.say(go_to).is_taken) << world.story();
  const auto is_sent = [&] { return world.durable().mission->revision == 2 && !world.durable().arrived; };
  ASSERT_TRUE(world.run_until(is_sent, 30)) << world.story();
  EXPECT_TRUE(shows(first)) << "its station goes on seeing its own plan";
  EXPECT_EQ(upload_and_wait(first), plan_verdict::refused) << world.story();
}

TEST_P(uploaded_in_flight, takes_the_place_of_a_paused_one_and_the_vehicle_holds_on_until_a_person_starts_it) {
  ASSERT_TRUE(pause());
  const auto was_at = world.vehicle().describe();
  ASSERT_EQ(upload_and_wait(second), plan_verdict::taken) << world.story();
  EXPECT_EQ(world.judged().end()[-2].verdict, plan_verdict::bringing) << "the station waits for the vehicle";
  world.run_for(10);
  EXPECT_TRUE(is_held()) << world.story();
  EXPECT_EQ(world.vehicle().describe().mode, was_at.mode);
  EXPECT_TRUE(shows(second));
  EXPECT_TRUE(world.shown_items().empty()) << "the station has it already";
  const auto reached_before = world.shown_reached().size();
  world.station_says(start_of(world, second));
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.start_answers().back().verdict, start_verdict::started);
  const std::vector<std::uint16_t> reached(world.shown_reached().begin() + static_cast<std::ptrdiff_t>(reached_before),
                                           world.shown_reached().end());
  ASSERT_FALSE(reached.empty()) << world.story();
  EXPECT_LE(reached.front(), first_waypoint()) << world.story();
  EXPECT_EQ(reached.back(), second.size() - 1) << world.story();
  EXPECT_TRUE(world.reactions().empty());
}

TEST_P(uploaded_in_flight, is_flown_on_at_an_operators_word_too) {
  ASSERT_TRUE(pause());
  ASSERT_EQ(upload_and_wait(second), plan_verdict::taken) << world.story();
  ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_TRUE(shows(second));
}

TEST_P(uploaded_in_flight, is_begun_at_the_item_that_is_named) {
  ASSERT_TRUE(pause());
  ASSERT_EQ(upload_and_wait(second), plan_verdict::taken) << world.story();
  const auto reached_before = world.shown_reached().size();
  auto from_last_waypoint = start_of(world, second);
  from_last_waypoint.first = static_cast<std::uint16_t>(first_waypoint() + 2);
  world.station_says(from_last_waypoint);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  ASSERT_GT(world.shown_reached().size(), reached_before) << world.story();
  EXPECT_EQ(world.shown_reached()[reached_before], from_last_waypoint.first) << world.story();
}

TEST_P(uploaded_in_flight, while_it_flies_it_is_refused_with_what_to_do_and_the_plan_goes_on) {
  const auto orders = world.orders();
  EXPECT_EQ(upload_and_wait(second), plan_verdict::refused);
  EXPECT_TRUE(was_said(world, "pause it, then upload, then start")) << world.story();
  EXPECT_EQ(world.orders(), orders) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_TRUE(shows(first));
}

TEST_P(uploaded_in_flight, of_another_station_it_is_refused) {
  ASSERT_TRUE(pause());
  auto of_another = taken(second);
  of_another.by = {254, 190};
  const auto orders = world.orders();
  world.station_says(of_another);
  EXPECT_EQ(world.judged().back().verdict, plan_verdict::refused);
  EXPECT_TRUE(was_said(world, "not this station's")) << world.story();
  world.run_for(5);
  EXPECT_EQ(world.orders(), orders) << world.story();
  EXPECT_TRUE(shows(first));
}

TEST_P(uploaded_in_flight, while_a_person_has_the_vehicle_it_is_refused_also_to_that_person) {
  ASSERT_TRUE(pause());
  ASSERT_EQ(world.station_does(act_kind::command).verdict, act_verdict::pass);
  const auto orders = world.orders();
  EXPECT_EQ(upload_and_wait(second), plan_verdict::refused);
  world.run_for(5);
  EXPECT_EQ(world.orders(), orders) << world.story();
}

TEST_P(uploaded_in_flight, what_can_not_be_flown_is_refused_and_nothing_is_sent) {
  ASSERT_TRUE(pause());
  auto guarded = item_of(mav_cmd::do_parachute, {});
  guarded.frame = number(mav_frame::mission);
  auto with_guarded = second;
  with_guarded.push_back(guarded);
  const auto orders = world.orders();
  EXPECT_EQ(upload_and_wait(numbered(with_guarded)), plan_verdict::refused);
  EXPECT_TRUE(was_said(world, "DO_PARACHUTE")) << world.story();
  EXPECT_EQ(world.orders(), orders) << world.story();
  ASSERT_TRUE(world.say(command_kind::resume).is_taken);
  EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_TRUE(shows(first));
}

TEST_P(uploaded_in_flight, what_does_not_come_to_the_vehicle_is_refused_and_the_plan_before_is_flown_on) {
  ASSERT_TRUE(pause());
  world.lose_message(io::mavlink::mission_count::message_id);
  const auto so_far = world.judged().size();
  world.station_says(taken(second));
  world.run_for(40);
  world.lose_message(0); // and now it can be asked what it holds
  ASSERT_TRUE(world.run_until([&] { return final_verdict(so_far).has_value(); }, 60)) << world.story();
  EXPECT_EQ(final_verdict(so_far), plan_verdict::refused) << world.story();
  EXPECT_EQ(world.durable().status.now, phase::paused) << world.story();
  EXPECT_TRUE(shows(first));
  ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.story();
  EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

TEST_P(uploaded_in_flight, who_takes_the_vehicle_meanwhile_keeps_it_and_what_became_of_it_is_said_after_the_hand_back) {
  ASSERT_TRUE(pause());
  const auto so_far = world.judged().size();
  world.station_says(taken(second));
  ASSERT_TRUE(world.run_until([&] { return world.is_uploading(); }, 10)) << world.story();
  ASSERT_EQ(world.station_does(act_kind::command, {254, 190}).verdict, act_verdict::pass);
  const auto orders = world.orders();
  world.run_for(20);
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
  EXPECT_EQ(world.orders(), orders) << world.story();
  ASSERT_TRUE(world.say(command_kind::hand_back).is_taken) << world.story();
  EXPECT_TRUE(world.run_until([&] { return final_verdict(so_far).has_value(); }, 60)) << world.story();
}

// Of the executor, and of the whole process, at many moments between the upload and its end.
TEST_P(uploaded_in_flight, a_crash_at_any_moment_of_it_leaves_one_plan_and_says_which) {
  for (int moment = 0; moment < 24; ++moment) {
    SCOPED_TRACE("moment " + std::to_string(moment));
    flight_world other(by_stations(GetParam()));
    ASSERT_TRUE(bring(other, first));
    ASSERT_TRUE(fly_two_items(other, first));
    ASSERT_TRUE(other.say(command_kind::pause).is_taken);
    ASSERT_TRUE(other.run_until([&] { return other.durable().status.cause == pause_cause::asked; }, 20));
    other.run_for(3);
    const auto so_far = other.judged().size();
    other.station_says(taken(second));
    other.run_for((moment / 2) * 0.025);
    if (moment % 2 == 0)
      other.crash();
    else
      other.crash_all();
    const auto verdicts = [&] {
      return std::count_if(other.judged().begin() + static_cast<std::ptrdiff_t>(so_far), other.judged().end(),
                           [](const auto& each) { return each.verdict != plan_verdict::bringing; });
    };
    ASSERT_TRUE(other.run_until([&] { return verdicts() > 0; }, 90)) << other.story();
    other.run_for(10);
    EXPECT_EQ(verdicts(), 1) << other.story();
    EXPECT_EQ(other.durable().status.now, phase::paused) << "no restart lets it fly: " << other.story();
    const auto& now_flown = other.judged().back().verdict == plan_verdict::taken ? second : first;
    ASSERT_TRUE(other.say(command_kind::resume).is_taken) << other.story();
    ASSERT_TRUE(other.run_until_phase(phase::done)) << other.story();
    EXPECT_EQ(other.shown_progress().back().plan_id, io::mavlink::checksum_of(now_flown)) << other.story();
  }
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, uploaded_in_flight,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot,
                                         sim::personality::plane),
                         [](const auto& who) { return std::string(io::name_of(who.param)); });

} // namespace upload_in_flight_test
} // namespace godwit::executor
