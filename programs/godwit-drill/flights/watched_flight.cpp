#include "programs/godwit-drill/flights/watched_flight.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "programs/godwit-drill/flight_simulation/short_mission.hpp"
#include "programs/godwit-drill/flight_simulation/vehicle_modes.hpp"

namespace godwit::drill {

namespace {

flight_simulation::options recorded(flight_simulation::options wanted, const flight_wishes& wishes) {
  wanted.is_recorded = true;
  wanted.planted = wishes.planted;
  return wanted;
}

// A check says so: after what has led it away a plane, for one, does not take off again.
constexpr const char* stands_still = "the vehicle is armed and in its mission mode, and has not moved";
constexpr const char* mission_can_not_be_flown = "The mission can not be flown by this vehicle";

// As a plane that was called home, until somebody lands it.
bool circles_at_home(const flight_simulation& flight) {
  const auto& at = flight.status();
  return flight.who() == sim::personality::plane && at.now == executor::phase::landing && !at.reason.empty() &&
         flight.vehicle().describe().mode == "RTL";
}

} // namespace

watched_flight::watched_flight(const flight_simulation::options& wanted, const flight_wishes& wishes, std::string name,
                               std::string group)
    : watched_flight(wanted, short_mission(wanted.who), wishes, std::move(name), std::move(group)) {}

watched_flight::watched_flight(flight_simulation::options wanted, const mission::document& mission,
                               const flight_wishes& wishes, std::string name, std::string group)
    : wishes_(wishes), flight_(recorded(std::move(wanted), wishes), mission) {
  outcome_.name = std::move(name);
  outcome_.group = std::move(group);
  if (!wishes_.trace_folder.empty())
    flight_.record().keep_trace(wishes_.trace_folder);
}

void watched_flight::expect(const std::string& flaw) {
  if (!flaw.empty())
    outcome_.flaws.push_back(flaw);
}

void watched_flight::note_recovery(double ms) { outcome_.recovery_ms = std::max(ms, outcome_.recovery_ms.value_or(0)); }

void watched_flight::note_recovery_since(std::int64_t since_ns) {
  note_recovery(static_cast<double>(flight_.now_ns() - since_ns) * 1e-6);
}

flight_outcome watched_flight::finish(flight_ends how) {
  const bool has_ended = fly_with_help(flight_);
  const bool waits = how == flight_ends::or_waits_with_the_rest && waits_for_another_mission(flight_);
  expect(has_ended || waits ? "" : "it has no end");
  expect(flaw_of_end(flight_));
  expect(flaw_of_place(flight_));
  return judge();
}

flight_outcome watched_flight::finish_or_wait() {
  constexpr double decides_within_s = 20; // what the last word of a person brings
  const auto waits = [&] {
    const auto& at = flight_.status();
    const bool is_with_person = at.now == executor::phase::paused || at.now == executor::phase::ready;
    return executor::is_at_rest(at.now) || (is_with_person && !at.reason.empty()) || circles_at_home(flight_) ||
           (at.now == executor::phase::preflight && flight_.was_told_last(mission_can_not_be_flown)) ||
           waits_for_disarm(flight_) || (at.now == executor::phase::flying && flight_.was_told_last(stands_still));
  };
  if (!circles_at_home(flight_))
    (void)fly_with_help(flight_);
  expect(flight_.run_until(waits, decides_within_s) ? "" : "it neither ends nor waits for a person");
  return judge();
}

flight_outcome watched_flight::judge() {
  for (const auto& each : flight_.audit().findings())
    expect(each);
  expect(flaw_of_reports(flight_));
  expect(flaw_of_truth(flight_));
  for (const auto& each : flight_.record().broken())
    expect(each);
  const auto counts = count_reports(flight_);
  outcome_.lost = counts.lost;
  outcome_.doubled = counts.doubled;
  outcome_.kills = static_cast<std::uint64_t>(std::max(flight_.processes() - 1, 0));
  outcome_.commits = flight_.commits();
  outcome_.deliveries = flight_.record().deliveries();
  if (const auto took_ns = flight_.process_recovery_ns())
    note_recovery(static_cast<double>(*took_ns) * 1e-6);
  outcome_.flown_s = static_cast<double>(flight_.now_ns()) * 1e-9;
  outcome_.took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  set_known_aside(outcome_);
  if (wishes_.tells_story || !outcome_.held())
    outcome_.story = flight_.story();
  return outcome_;
}

namespace {

constexpr std::array all_known{
    known_finding{"replaced_and_killed/commit_25", "there are two different reports 1 of mission"},
    known_finding{"replaced_and_killed/commit_25", "is of generation 1, after generation 2"},
};

} // namespace

std::span<const known_finding> known_findings() { return all_known; }

void set_known_aside(flight_outcome& each, std::span<const known_finding> all) {
  const auto is_known = [&](const std::string& flaw) {
    return std::ranges::any_of(all, [&](const known_finding& known) {
      return each.name.find(known.in_name) != std::string::npos && flaw.find(known.in_flaw) != std::string::npos;
    });
  };
  std::ranges::copy_if(each.flaws, std::back_inserter(each.known), is_known);
  std::erase_if(each.flaws, is_known);
}

bool take_by_hand(flight_simulation& flight) {
  const auto before = flight.vehicle().describe().mode;
  flight.switch_mode(pilot_mode(flight.who()));
  return flight.vehicle().describe().mode != before;
}

void expect_left_alone(watched_flight& watched, bool must_see) {
  constexpr double seen_within_s = 3; // heartbeats come each second, and those of a mode change at once
  constexpr double left_alone_s = 15;
  auto& flight = watched.flight();
  const auto taken_ns = flight.now_ns();
  const auto is_seen = [&] { return executor::needs_hand_back(flight.status().cause); };
  if (flight.run_until(is_seen, seen_within_s)) {
    ++watched.so_far().takeovers;
    watched.note_recovery_since(taken_ns);
  } else {
    watched.expect(must_see ? "godwit has not seen that a person has the vehicle" : "");
  }
  const auto since_ns = flight.now_ns();
  flight.run_for(left_alone_s);
  const auto moves = moves_since(flight, since_ns);
  watched.expect(moves == 0 ? "" : std::to_string(moves) + " commands went out while a person had the vehicle");
}

} // namespace godwit::drill
