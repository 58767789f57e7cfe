// Each row of the phase table, from each phase that it names, and each guard both ways: what is expected is written
// here once more. What no line here names has no way on.
#include "actors/executor/flight/phase_table.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "io/fields/field_table.hpp"
#include "io/mavlink/enums.hpp"

namespace godwit::executor {
namespace phase_rows_test {

using enum phase;
using enum pause_cause;
using progress::pause_reason;

struct circumstances {
  bool in_flight = false;
  pause_cause cause = none;
  bool is_finished = false; // the plan
  bool is_way_home = false; // so is what is flown
  bool ends_mission = false;
  std::optional<pause_reason> paused = {};
  bool has_service = true;
  bool in_air = false;
  bool in_mission_mode = false;
};

constexpr circumstances nothing;
constexpr circumstances flown{.in_flight = true};
constexpr circumstances flown_to_end{.in_flight = true, .is_finished = true};
constexpr circumstances way_home{.in_flight = true, .is_way_home = true};
constexpr circumstances ends_in_air{.in_flight = true, .is_finished = true, .in_air = true};
constexpr circumstances called{.in_flight = true, .paused = pause_reason::aborted};
constexpr circumstances called_at_end{
    .in_flight = true, .is_finished = true, .paused = pause_reason::aborted, .in_air = true};
constexpr circumstances in_air{.in_air = true};

// As `flight_bit`, by what comes of it.
enum class flies_on { as_before, yes, no };

struct way {
  trigger on;
  std::vector<phase> from;
  circumstances given;
  std::optional<phase> to; // none: it stays
  pause_cause cause = none;
  flies_on in_flight = flies_on::as_before;
  std::string reason = "its own"; // a part of it; "its own": that of whoever says it
};

using phases = std::vector<phase>;

const phases ground{disconnected, connected, preflight, uploading, ready, starting};
const phases ground_or_paused{disconnected, connected, preflight, uploading, ready, starting, paused};
const phases under_way{flying, pausing, landing};
const phases flight{flying, pausing, landing, paused};
const phases open{disconnected, connected, preflight, uploading, ready, starting, flying, pausing, landing, paused};
const phases over{post_flight, done, aborted};
const phases ground_or_over{disconnected, connected, preflight, uploading, ready, starting, post_flight, done, aborted};
const phases not_flown{disconnected, connected, preflight,   uploading, ready,
                       starting,     paused,    post_flight, done,      aborted};
const phases without_task{disconnected, connected, preflight, ready, post_flight, done, aborted};
const phases all{disconnected, connected, preflight, uploading,   ready, starting, flying,
                 pausing,      landing,   paused,    post_flight, done,  aborted};

constexpr auto yes = flies_on::yes;
constexpr auto no = flies_on::no;
constexpr auto as_before = flies_on::as_before;

std::vector<way> on_ground() {
  using enum trigger;
  return {
      {link_lost, {disconnected, connected, preflight, ready, done, aborted}, nothing, disconnected},
      {link_found, {disconnected}, nothing, connected},
      {mission_changed, {disconnected, connected, preflight, ready, paused, done, aborted}, nothing, connected},
      {prepare_again, {paused}, nothing, connected},
      {checks_begun, {connected, preflight, ready}, nothing, preflight},
      {checks_passed, {preflight}, nothing, uploading},
      {rest_refused, {preflight}, nothing, paused, not_done},
      {plan_brought, ground_or_paused, nothing, ready},
      {start_waits, {ready}, nothing, {}, none, as_before, "a person has to start it"},
      {start_begun, {ready}, nothing, starting},
      {start_refused, ground_or_paused, nothing, ready},
      {start_failed, ground_or_paused, nothing, paused, not_done, no},
      {start_failed, ground_or_paused, in_air, paused, not_done, yes},
      {start_stopped, ground_or_paused, nothing, paused, asked, no, "resume prepares the flight again"},
      {start_waits, {paused}, {.cause = restarted}, {}, restarted},
      {started, not_flown, nothing, flying, none, yes},
      {found_started, {ready, paused}, nothing, flying, none, yes},
      {held, ground_or_over, nothing, paused, asked, no, "resume prepares the flight"},
      {called_home, not_flown, nothing, paused, asked, no, "resume prepares the flight"},
      {not_obeyed, ground_or_over, {.cause = restarted}, {}, restarted},
      {task_failed, ground_or_paused, nothing, paused, not_done},
      {restarted_on_ground, ground_or_paused, nothing, paused, restarted, no, "resume prepares the flight again"},
  };
}

std::vector<way> in_flight() {
  using enum trigger;
  return {
      {plan_brought, flight, flown, flying, none, yes},
      {plan_brought_held, flight, flown, paused, asked, yes, "held as asked"},
      {plan_done, {flying}, ends_in_air, paused, plan_ended, yes, "ends in the air"},
      {plan_done, {flying}, flown_to_end, landing, none, yes},
      {told_to_hold, under_way, flown, pausing, none, yes, "commanded to hold"},
      {held, flight, flown, paused, asked, yes, "held as asked"},
      {resumed, flight, ends_in_air, paused, plan_ended, yes, "ends in the air"},
      {resumed, flight, flown_to_end, landing, none, yes},
      {resumed, flight, way_home, landing, none, yes},
      {resumed, flight, flown, flying, none, yes},
      {called_home, flight, flown, landing, none, yes, "the vehicle returns"},
      {called_home_by_plan, flight, flown, flying, none, yes, "flies around the fences"},
      {not_obeyed, {pausing}, ends_in_air, paused, plan_ended, yes, "ends in the air"},
      {not_obeyed, {pausing}, flown_to_end, landing, none, yes},
      {not_obeyed, {pausing}, way_home, landing, none, yes},
      {not_obeyed, {pausing}, called, landing, none, yes},
      {not_obeyed, {pausing}, called_at_end, landing, none, yes},
      {not_obeyed, {pausing}, flown, flying, none, yes},
      {not_obeyed, {flying, landing}, flown, {}, none, yes},
      {task_failed, flight, flown, paused, not_done, yes},
      {replan_left_open, flight, flown, paused, asked, yes, "resume starts the new one"},
      {found_held, open, flown, paused, asked, yes, "held as asked"},
      {found_on_its_way, open, nothing, flying, none, yes},
      {found_in_flight, flight, ends_in_air, paused, plan_ended, yes, "ends in the air"},
      {found_in_flight, {landing}, flown, landing, none, yes},
      {found_in_flight, {pausing}, called, landing, none, yes},
      {found_in_flight, {pausing}, flown, flying, none, yes},
      {found_in_flight, {flying, pausing, paused}, flown_to_end, landing, none, yes},
      {found_in_flight, {flying, pausing, paused}, way_home, landing, none, yes},
      {found_in_flight, {flying, paused}, flown, flying, none, yes},
      {found_in_flight, ground, nothing, flying, none, yes},
  };
}

std::vector<way> who_has_it() {
  using enum trigger;
  std::vector<way> result{
      {person_acts_on_ground, without_task, nothing, {}, taken_over, no},
      {person_acts_on_ground, {uploading, starting, flying, pausing, landing, paused}, nothing, paused, taken_over, no},
      {handed_back, without_task, {.cause = taken_over}, {}, none, no},
      {handed_back, {paused}, nothing, paused, asked, no, "waits for a command"},
      {handed_back, {paused}, flown, paused, asked, yes, "waits for a command"},
      {handed_back, {paused}, ends_in_air, paused, plan_ended, yes, "ends in the air"},
      {handed_back, {paused}, {.in_flight = true, .is_finished = true, .in_mission_mode = true}, landing, none, yes},
      {handed_back, {paused}, {.in_flight = true, .in_mission_mode = true}, flying, none, yes},
      {handed_back,
       {paused},
       {.in_flight = true, .paused = pause_reason::foreign_plan},
       paused,
       foreign_plan,
       yes,
       "not godwit's"},
      {handed_back,
       {paused},
       {.in_flight = true, .paused = pause_reason::infeasible_plan},
       paused,
       infeasible_plan,
       yes,
       "can not be flown"},
      {handed_back,
       {paused},
       {.in_flight = true, .paused = pause_reason::vehicle_restarted},
       paused,
       vehicle_restarted,
       yes,
       "started again"},
      {foreign_plan_found, all, nothing, paused, foreign_plan, no, "not godwit's"},
      {infeasible_plan_found, open, nothing, paused, infeasible_plan, no, "can not be flown"},
      {autopilot_restarted, open, nothing, paused, vehicle_restarted, no, "started again"},
  };
  for (const auto& [on, why] : {std::pair{person_took_over, taken_over},
                                {failsafe_acts, failsafe},
                                {autopilot_failsafe_acts, autopilot_failsafe}}) {
    result.push_back({on, all, nothing, paused, why, no});
    result.push_back({on, all, flown, paused, why, yes});
    result.push_back({on, all, in_air, paused, why, yes});
  }
  return result;
}

std::vector<way> at_the_end() {
  using enum trigger;
  constexpr circumstances complete{.in_flight = true, .is_finished = true, .ends_mission = true};
  constexpr circumstances complete_of_file{
      .in_flight = true, .is_finished = true, .ends_mission = true, .has_service = false};
  constexpr circumstances with_person{.in_flight = true, .cause = taken_over};
  constexpr circumstances with_failsafe_at_end{.in_flight = true, .cause = failsafe, .is_finished = true};
  constexpr circumstances with_autopilots_failsafe{.in_flight = true, .cause = autopilot_failsafe};
  constexpr circumstances with_person_complete{
      .in_flight = true, .cause = taken_over, .is_finished = true, .ends_mission = true};
  return {
      {flight_ended,
       flight,
       {.in_flight = true, .paused = pause_reason::vehicle_restarted},
       paused,
       taken_over,
       no,
       "autopilot started again"},
      {flight_ended, flight, with_person, paused, taken_over, no, "under manual control"},
      {flight_ended, flight, with_failsafe_at_end, paused, failsafe, no, "after a failsafe took the vehicle"},
      {flight_ended, flight, with_autopilots_failsafe, paused, autopilot_failsafe, no,
       "after a failsafe took the vehicle"},
      {flight_ended, flight, flown_to_end, connected, none, no},
      {flight_ended, flight, flown, paused, taken_over, no, "not by godwit"},
      {mission_ended, open, complete, post_flight, none, no},
      {mission_ended, open, with_person_complete, post_flight, taken_over, no},
      {mission_ended, open, complete_of_file, done, none, no},
      {mission_ended, open, flown, aborted, none, no},
      {mission_ended, open, with_person, aborted, taken_over, no},
      {delivered, {post_flight}, {.cause = taken_over}, done, taken_over, no},
  };
}

std::vector<way> all_ways() {
  std::vector<way> result;
  for (const auto& part : {on_ground(), in_flight(), who_has_it(), at_the_end()})
    result.insert(result.end(), part.begin(), part.end());
  return result;
}

state durable_of(const circumstances& given, phase from) {
  state s;
  s.status = {from, given.cause, "before", given.in_flight};
  s.progress.plan.emplace();
  s.progress.plan->generation.is_finished = given.is_finished;
  s.progress.plan->map.ends_mission = given.ends_mission;
  if (!given.is_way_home)
    s.progress.plan->map.items.emplace_back();
  s.progress.paused = given.paused;
  return s;
}

// A Copter: 3 is its mission mode, 5 LOITER.
void show(vehicle_view& view, const circumstances& given) {
  using io::mavlink::number;
  constexpr std::uint8_t custom_mode_enabled = 1;
  constexpr std::uint8_t armed = 128;
  io::mavlink::heartbeat beat;
  beat.type = number(io::mavlink::mav_type::quadrotor);
  beat.autopilot = number(io::mavlink::mav_autopilot::ardupilotmega);
  beat.custom_mode = given.in_mission_mode ? 3 : 5;
  beat.base_mode = custom_mode_enabled | (given.in_air ? armed : 0);
  view.take(beat, 1);
  io::mavlink::extended_sys_state landed;
  landed.landed_state =
      number(given.in_air ? io::mavlink::mav_landed_state::in_air : io::mavlink::mav_landed_state::on_ground);
  view.take(landed);
}

// What became of one way, and which rows were looked at for it.
struct tried {
  explicit tried(const way& which, phase from) : s(durable_of(which.given, from)), flight(configured(which), s) {
    show(flight.view, which.given);
    phase_machine machine(flight);
    effects out;
    machine.go(out, which.on, which.reason == "its own" ? "its own" : "");
    after = out.empty() ? s.status : std::get<phase_status>(std::get<note>(out.front()).what);
    const auto& counts = machine.taken();
    const auto taken =
        std::ranges::find_if(counts, [&](const auto& each) { return each[static_cast<std::size_t>(from)] > 0; });
    row = static_cast<std::size_t>(taken - counts.begin());
  }
  static settings configured(const way& which) {
    settings result;
    result.has_service = which.given.has_service;
    return result;
  }

  state s;
  flight_context flight;
  phase_status after;
  std::size_t row = 0;
};

TEST(phase_rows, each_leads_where_it_should) {
  for (const auto& each : all_ways())
    for (const auto from : each.from) {
      const auto what = std::string(io::name_of(each.on)) + " from " + std::string(io::name_of(from));
      const tried one(each, from);
      EXPECT_EQ(one.after.now, each.to.value_or(from)) << what;
      EXPECT_EQ(one.after.cause, each.cause) << what;
      EXPECT_EQ(one.after.in_flight, each.in_flight == as_before ? each.given.in_flight : each.in_flight == yes)
          << what;
      EXPECT_NE(one.after.reason.find(each.reason), std::string::npos) << what << ": " << one.after.reason;
    }
}

// One that stands after a row without a guard is never taken.
bool is_shadowed(std::size_t row, phase from) {
  const auto rows = phase_table();
  return std::ranges::any_of(rows.first(row), [&](const transition& each) {
    return each.on == rows[row].on && each.holds == nullptr && has(each.from, from);
  });
}

TEST(phase_rows, each_is_taken_from_each_of_its_phases_and_each_guard_is_met_both_ways) {
  const auto rows = phase_table();
  std::vector<phase_set> taken(rows.size());
  std::vector<bool> holds(rows.size());
  std::vector<bool> fails(rows.size());
  for (const auto& each : all_ways())
    for (const auto from : each.from) {
      const tried one(each, from);
      taken[one.row] |= 1U << static_cast<unsigned>(from);
      for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].on == each.on && rows[i].holds != nullptr && has(rows[i].from, from))
          (rows[i].holds(one.flight) ? holds : fails)[i] = true;
    }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto what = std::string(io::name_of(rows[i].on)) + " [" + std::string(rows[i].guard) + "]";
    for (const auto from : all)
      EXPECT_TRUE(!has(rows[i].from, from) || has(taken[i], from) || is_shadowed(i, from))
          << what << " is never taken from " << io::name_of(from);
    EXPECT_TRUE(rows[i].holds == nullptr || (holds[i] && fails[i])) << what;
  }
}

TEST(phase_rows, there_is_none_but_those_that_are_named_here) {
  const auto ways = all_ways();
  for (const auto& row : phase_table())
    for (const auto from : all)
      EXPECT_TRUE(!has(row.from, from) || std::ranges::any_of(ways,
                                                              [&](const way& each) {
                                                                return each.on == row.on &&
                                                                       std::ranges::find(each.from, from) !=
                                                                           each.from.end();
                                                              }))
          << io::name_of(row.on) << " from " << io::name_of(from);
}

} // namespace phase_rows_test
} // namespace godwit::executor
