// A person takes the vehicle by a mode of it, and godwit knows of it from the vehicle alone: nothing is commanded
// after that until somebody hands it back. Then they say that it goes on; where godwit can not (a plane does not take
// off again) it waits, and says for what.
//
// The mission mode is none of these modes: while the mission flies nobody can tell it from godwit's own.
#include <array>

#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "programs/godwit-drill/flight_simulation/short_mission.hpp"
#include "programs/godwit-drill/flight_simulation/vehicle_modes.hpp"
#include "programs/godwit-drill/flights/disturbed_flight.hpp"
#include "programs/godwit-drill/flights/flight_case.hpp"
#include "programs/godwit-drill/flights/watched_flight.hpp"

namespace godwit::drill {

namespace {

using executor::pause_cause;
using executor::phase;

constexpr std::array parts{phase::ready, phase::starting, phase::flying, phase::landing, phase::paused};

struct takeover {
  sim::personality who;
  phase part; // paused: in flight, by a word of an operator
  sim::flight_mode mode;
  mode_form how = mode_form::set_mode;
  bool is_on_other_line = false;

  [[nodiscard]] std::string group() const { return row_of(who, io::name_of(part)); }
  [[nodiscard]] std::string name() const { return group() + "/" + std::string(mode.name); }
};

// False: the flight has no such part.
bool bring_to(flight_simulation& flight, phase part) {
  const auto is_there = [&] { return flight.status().now == part || executor::is_at_rest(flight.status().now); };
  if (part != phase::paused && part != phase::flying)
    return flight.run_until(is_there, 120) && flight.status().now == part;
  const auto is_on_its_way = [&] {
    const auto seen = flight.vehicle().describe();
    return flight.status().now == phase::flying && (seen.in_air || flight.who() == sim::personality::rover);
  };
  if (!flight.run_until(is_on_its_way, 120))
    return false;
  flight.run_for(1);
  if (part == phase::flying)
    return flight.status().now == phase::flying;
  flight.say(operators::command_kind::pause);
  const bool is_paused = flight.run_until_phase(phase::paused, 20);
  flight.run_for(6); // an order of the last 5 s could be what changed the mode
  return is_paused && flight.status().cause == pause_cause::asked;
}

// Why it can not be taken here; empty: it is.
std::string take(flight_simulation& flight, const takeover& what) {
  if (!bring_to(flight, what.part))
    return "the flight has no such part";
  if (flight.vehicle().describe().mode == what.mode.name)
    return "it is in this mode already";
  flight.switch_mode(what.mode.custom, what.how);
  flight.run_for(0.1);
  return flight.vehicle().describe().mode == what.mode.name ? "" : "the vehicle does not change to it";
}

void leave_alone(watched_flight& watched, const takeover& what) {
  auto& flight = watched.flight();
  expect_left_alone(watched, what.part != phase::ready); // there it is enough that nothing is commanded
  const auto seen = flight.vehicle().describe();
  if (!seen.armed && seen.mode == what.mode.name)
    flight.switch_mode(pilot_mode(what.who)); // who hands it back on the ground leaves it in a mode that can be armed
}

flight_outcome fly(const takeover& what, const flight_wishes& wishes) {
  const bool waits_for_start = what.part == phase::ready;
  watched_flight watched(
      {.who = what.who, .starts_by_itself = !waits_for_start, .is_person_on_other_line = what.is_on_other_line}, wishes,
      what.name(), what.group());
  watched.so_far().skipped = take(watched.flight(), what);
  if (watched.so_far().skipped.empty())
    leave_alone(watched, what);
  if (waits_for_start)
    watched.expect(start_by_station(watched.flight()) ? "" : "a station could not start it");
  return watched.finish_or_wait();
}

} // namespace

std::vector<flight_case> people_cases(vehicles which) {
  std::vector<flight_case> result;
  for (const auto who : which)
    for (const auto part : parts)
      for (std::size_t index = 0; index < modes_of(who).size(); ++index) {
        const auto& mode = modes_of(who)[index];
        if (mode.kind == sim::mode_kind::mission)
          continue;
        // Each form and both lines by turns: godwit knows it by heartbeats, whatever the form and the line.
        const auto turn = index + static_cast<std::size_t>(part);
        const takeover what{who, part, mode, all_mode_forms.at(turn % all_mode_forms.size()), turn % 2 == 1};
        result.push_back(
            {what.name(), what.group(), [what](const flight_wishes& wishes) { return fly(what, wishes); }});
      }
  return result;
}

// More of people beside a flight: one takes the vehicle on the way to each item, a second time after a hand-back, and
// while godwitd is dead; and two operators contradict each other.

namespace {

using operators::command_kind;

constexpr std::array under_way{phase::starting, phase::flying, phase::landing};

// -- on the way to an item --------------------------------------------------------------------------

// False: the flight has no such moment.
bool fly_towards(flight_simulation& flight, int item) {
  const auto is_there = [&] {
    const auto& at = flight.status();
    return executor::is_over(at.now) ||
           (at.now == phase::flying && flight.vehicle().describe().mission_current >= item);
  };
  return flight.run_until(is_there, 300) && flight.status().now == phase::flying;
}

flight_case taken_at_item(sim::personality who, int item) {
  const auto group = row_of(who, "items");
  const auto name = group + "/" + std::to_string(item);
  return {name, group, [=](const flight_wishes& wishes) {
            watched_flight watched({.who = who}, wishes, name, group);
            auto& flight = watched.flight();
            if (!fly_towards(flight, item) || !flight.vehicle().describe().armed) {
              watched.so_far().skipped = "the flight has no such moment";
              return watched.finish_or_wait();
            }
            if (take_by_hand(flight))
              expect_left_alone(watched);
            return watched.finish_or_wait();
          }};
}

// -- a second time ----------------------------------------------------------------------------------

// True: the mission is flown again.
bool hand_back(flight_simulation& flight) {
  flight.say(command_kind::hand_back);
  flight.run_for(1);
  flight.say(command_kind::resume);
  return flight.run_until(
      [&] { return flight.status().now == phase::flying && !executor::needs_hand_back(flight.status().cause); }, 10);
}

std::string take_twice(watched_flight& watched) {
  constexpr double lifts_off_within_s = 10;
  auto& flight = watched.flight();
  const auto is_off = [&] { // else it would be down when it is handed back
    return flight.status().now != phase::flying || flight.vehicle().describe().in_air ||
           flight.who() == sim::personality::rover;
  };
  (void)flight.run_until(is_off, lifts_off_within_s);
  flight.run_for(1);
  if (!flight.vehicle().describe().armed)
    return "nobody takes a vehicle that is not armed";
  if (!take_by_hand(flight))
    return "it is in this mode already";
  expect_left_alone(watched);
  if (!hand_back(flight))
    return "the mission is not flown again after the hand-back";
  flight.run_for(1);
  watched.expect(take_by_hand(flight) ? "" : "the mission is flown in a mode of a pilot");
  expect_left_alone(watched);
  return {};
}

// -- while godwitd is dead --------------------------------------------------------------------------

// OFF_S: 0: it is killed and begins again at once. In a start the next process waits for a person in any case, and it
// is enough that nothing is commanded.
std::string take_from_the_dead(watched_flight& watched, double off_s) {
  auto& flight = watched.flight();
  const bool must_see = flight.status().now != phase::starting;
  if (!flight.vehicle().describe().armed)
    return "nobody takes a vehicle that is not armed";
  if (off_s > 0)
    flight.lose_power(off_s);
  else
    flight.kill_process();
  flight.run_for(off_s / 2);
  if (!take_by_hand(flight))
    return "it is in this mode already";
  (void)flight.run_until([&] { return flight.process() != nullptr; }, off_s + 1);
  expect_left_alone(watched, must_see);
  return {};
}

// -- two operators ----------------------------------------------------------------------------------

struct contradiction {
  command_kind first;
  command_kind second;
  double apart_s;

  [[nodiscard]] std::string name() const {
    return std::string(io::name_of(first)) + "_and_" + std::string(io::name_of(second)) +
           (apart_s > 0 ? "_later" : "_at_once");
  }
};

std::vector<contradiction> contradictions() {
  constexpr std::array words{command_kind::pause, command_kind::resume, command_kind::come_home, command_kind::start};
  std::vector<contradiction> result;
  for (const auto first : words)
    for (const auto second : words)
      for (const auto apart_s : {0.0, 0.3})
        if (first != second)
          result.push_back({first, second, apart_s});
  return result;
}

void say(flight_simulation& flight, command_kind what, const char* by) {
  operators::command word;
  word.kind = what;
  word.by = by;
  flight.say(word);
}

// Who stops it has the last word when that was the last word; each is told how the flight stands.
std::string contradict(watched_flight& watched, const contradiction& what) {
  constexpr double carried_out_within_s = 8;
  auto& flight = watched.flight();
  say(flight, what.first, "first");
  flight.run_for(what.apart_s);
  say(flight, what.second, "second");
  flight.run_for(carried_out_within_s);
  const auto& at = flight.status();
  const bool is_mission_flown = at.now == phase::flying || at.now == phase::pausing || at.now == phase::starting;
  const bool stops = what.second == command_kind::pause || what.second == command_kind::come_home;
  watched.expect(stops && is_mission_flown ? "the last word was to stop, and the mission is flown" : "");
  watched.expect(at.now == phase::paused && at.reason.empty() ? "it is paused without a reason" : "");
  return {};
}

} // namespace

std::vector<flight_case> takeover_cases(vehicles which) {
  std::vector<flight_case> result;
  for (const auto who : which) {
    const auto items = static_cast<int>(short_mission(who).items.size());
    for (int item = 0; item <= items; ++item)
      result.push_back(taken_at_item(who, item));
    for (const auto part : under_way) {
      const auto add = [&](const std::string& what, std::function<std::string(watched_flight&)> disturb) {
        result.push_back(case_of({.wanted = {.who = who},
                                  .part = part,
                                  .what = what,
                                  .end = flight_end::or_waits,
                                  .disturb = std::move(disturb)}));
      };
      add("twice", take_twice);
      add("while_dead", [](watched_flight& watched) { return take_from_the_dead(watched, 0); });
      add("while_off_5s", [](watched_flight& watched) { return take_from_the_dead(watched, 5); });
      for (const auto& each : contradictions())
        add(each.name(), [each](watched_flight& watched) { return contradict(watched, each); });
    }
  }
  return result;
}

} // namespace godwit::drill
