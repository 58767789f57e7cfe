// More of people beside a flight: one takes the vehicle on the way to each item, a second time after a hand-back, and
// while godwitd is dead; and two operators contradict each other.
#include <array>

#include "programs/godwit-drill/flight_simulation/short_mission.hpp"
#include "programs/godwit-drill/flights/disturbed_flight.hpp"
#include "programs/godwit-drill/flights/left_alone.hpp"

namespace godwit::drill {
namespace {

using executor::phase;
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
  const bool is_mission_flown = at.now == phase::flying || at.now == phase::starting;
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
