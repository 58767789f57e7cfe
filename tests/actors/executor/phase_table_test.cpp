// The phase table as a whole; each of its rows: phase_rows_test.cpp. What takes which row is tested by flights.
#include "actors/executor/flight/phase_table.hpp"

#include <algorithm>
#include <optional>

#include <gtest/gtest.h>

#include "io/fields/field_table.hpp"

namespace godwit::executor {
namespace phase_table_test {

constexpr auto last_trigger = static_cast<int>(trigger::delivered);
constexpr auto last_phase = static_cast<int>(phase::aborted);

bool has_row_without_guard(trigger on, phase from) {
  return std::ranges::any_of(phase_table(), [&](const transition& each) {
    return each.on == on && has(each.from, from) && each.holds == nullptr;
  });
}

bool has_row(trigger on, phase from) {
  return std::ranges::any_of(phase_table(),
                             [&](const transition& each) { return each.on == on && has(each.from, from); });
}

phase_status stands_in(phase now, pause_cause cause = pause_cause::none, bool in_flight = false) {
  return {now, cause, "before", in_flight};
}

std::optional<phase_status> noted(const effects& out) {
  if (out.empty())
    return {};
  return std::get<phase_status>(std::get<note>(out.front()).what);
}

TEST(phase_table, each_trigger_has_a_row) {
  for (int on = 0; on <= last_trigger; ++on)
    EXPECT_TRUE(std::ranges::any_of(phase_table(), [&](const transition& each) {
      return static_cast<int>(each.on) == on;
    })) << io::name_of(static_cast<trigger>(on));
}

TEST(phase_table, what_takes_the_vehicle_from_godwit_pauses_in_each_phase) {
  for (const auto on : {trigger::person_took_over, trigger::failsafe_acts, trigger::autopilot_failsafe_acts,
                        trigger::foreign_plan_found})
    for (int from = 0; from <= last_phase; ++from) {
      state s;
      s.status = stands_in(static_cast<phase>(from));
      flight_context flight({}, s);
      phase_machine machine(flight);
      effects out;
      machine.go(out, on, "why");
      ASSERT_TRUE(noted(out)) << io::name_of(on);
      EXPECT_EQ(noted(out)->now, phase::paused) << io::name_of(on);
      EXPECT_EQ(noted(out)->reason.empty(), false);
    }
}

TEST(phase_table, a_plan_that_is_lost_pauses_whatever_is_not_over) {
  for (const auto on : {trigger::infeasible_plan_found, trigger::autopilot_restarted})
    for (int from = 0; from <= last_phase; ++from)
      EXPECT_EQ(has_row(on, static_cast<phase>(from)), !is_over(static_cast<phase>(from))) << io::name_of(on);
}

TEST(phase_table, nothing_but_what_takes_the_vehicle_begins_in_any_phase) {
  constexpr phase_set any = (1U << phase_count) - 1;
  EXPECT_LE(std::ranges::count(phase_table(), any, &transition::from), 4);
}

// The first row that fits counts: one after a row without a guard would never be taken.
TEST(phase_table, no_row_hides_behind_another) {
  const auto rows = phase_table();
  for (std::size_t late = 0; late < rows.size(); ++late)
    for (std::size_t early = 0; early < late; ++early)
      EXPECT_FALSE(rows[early].on == rows[late].on && rows[early].holds == nullptr &&
                   (rows[early].from & rows[late].from) == rows[late].from)
          << io::name_of(rows[late].on) << ", row " << late;
}

TEST(phase_table, where_a_guard_decides_there_is_a_row_for_the_other_case) {
  for (const auto& each : phase_table())
    for (int from = 0; from <= last_phase; ++from) {
      const auto at = static_cast<phase>(from);
      const bool is_guarded = each.holds != nullptr && has(each.from, at);
      EXPECT_TRUE(!is_guarded || has_row_without_guard(each.on, at))
          << io::name_of(each.on) << " from " << io::name_of(at);
    }
}

TEST(phase_table, a_trigger_without_a_row_throws) {
  for (int on = 0; on <= last_trigger; ++on)
    for (int from = 0; from <= last_phase; ++from) {
      if (has_row(static_cast<trigger>(on), static_cast<phase>(from)))
        continue;
      state s;
      s.status = stands_in(static_cast<phase>(from));
      flight_context flight({}, s);
      phase_machine machine(flight);
      effects out;
      EXPECT_THROW(machine.go(out, static_cast<trigger>(on)), std::logic_error)
          << io::name_of(static_cast<trigger>(on));
    }
}

TEST(phase_table, the_same_standing_is_not_noted_again) {
  state s;
  s.status = {phase::connected, pause_cause::none, "", false};
  flight_context flight({}, s);
  phase_machine machine(flight);
  effects out;
  machine.go(out, trigger::mission_changed);
  EXPECT_TRUE(out.empty());
}

TEST(phase_table, a_pause_that_was_asked_for_ends_with_the_mission) {
  state s;
  s.status = stands_in(phase::paused, pause_cause::asked, true);
  flight_context flight({}, s);
  phase_machine machine(flight);
  effects out;
  machine.go(out, trigger::mission_ended);
  ASSERT_TRUE(noted(out));
  EXPECT_EQ(noted(out)->cause, pause_cause::none);
}

} // namespace phase_table_test
} // namespace godwit::executor
