#include "programs/godwit-drill/flight_simulation/flight_people.hpp"

#include <charconv>
#include <string_view>
#include <utility>

namespace godwit::drill {

using executor::phase;

namespace {

// The last command about the mission is at the service.
bool is_told(flight_simulation& flight) {
  const auto reports = flight.reports();
  return !reports.empty() && (reports.back().kind == mission::progress_kind::complete ||
                              reports.back().kind == mission::progress_kind::aborted);
}

// The preflight report that an operator was asked to acknowledge last. Nothing: none ever was.
std::optional<std::uint32_t> asked_report(flight_simulation& flight) {
  constexpr std::string_view words = " waits for an acknowledgement";
  constexpr std::string_view before = "preflight report ";
  const auto story = flight.story();
  const auto at = story.rfind(words);
  const auto from = at == std::string::npos ? at : story.rfind(before, at);
  if (from == std::string::npos)
    return std::nullopt;
  std::uint32_t number = 0;
  std::from_chars(story.data() + from + before.size(), story.data() + at, number);
  return number;
}

void acknowledge(flight_simulation& flight) {
  const auto report = asked_report(flight);
  if (flight.status().now != phase::preflight || !report)
    return;
  operators::command command;
  command.kind = operators::command_kind::acknowledge;
  command.report = *report;
  flight.say(std::move(command));
}

} // namespace

bool has_nothing_to_fly(const flight_simulation& flight) {
  return flight.status().now == phase::connected && flight.was_told("It has ended there and is not flown again");
}

bool waits_for_another_mission(const flight_simulation& flight) {
  const auto& at = flight.status();
  return at.now == phase::paused && at.reason.find("can not be flown from here") != std::string::npos;
}

bool waits_for_disarm(const flight_simulation& flight) {
  const auto now = flight.status().now;
  return (now == phase::preflight || now == phase::ready) && flight.vehicle().describe().armed &&
         flight.was_told_last("stands armed in a mode in which it goes off by itself");
}

bool fly_with_help(flight_simulation& flight) {
  constexpr int most_times = 60;
  constexpr double patience_s = 30;
  constexpr double delivery_s = 60; // five tries with their back-off
  const auto is_at_rest = [&] { return executor::is_at_rest(flight.status().now) || has_nothing_to_fly(flight); };
  const auto waits = [&] { // for a person: to be resumed, or to be started again
    const auto& at = flight.status();
    return at.now == phase::paused || (at.now == phase::ready && !at.reason.empty()) || waits_for_disarm(flight);
  };
  for (int i = 0; i < most_times && !is_at_rest(); ++i) {
    (void)flight.run_until([&] { return is_at_rest() || waits(); }, patience_s);
    if (is_at_rest() || waits_for_another_mission(flight))
      break;
    if (!flight.vehicle().describe().in_air)
      flight.vehicle().set_battery(100, flight.now_ns());
    if (executor::needs_hand_back(flight.status().cause))
      flight.say(operators::command_kind::hand_back);
    if (waits_for_disarm(flight))
      flight.person().disarm();
    flight.run_for(1);
    if (flight.status().now == phase::paused)
      flight.say(operators::command_kind::resume);
    else if (waits())
      flight.say(operators::command_kind::start);
    else
      acknowledge(flight);
    flight.run_for(1);
  }
  return is_at_rest() && flight.run_until([&] { return is_told(flight); }, delivery_s);
}

bool start_by_station(flight_simulation& flight) {
  constexpr int most_times = 20;
  const auto is_under_way = [&] { return flight.status().in_flight || executor::is_at_rest(flight.status().now); };
  for (int i = 0; i < most_times && !is_under_way(); ++i) {
    if (executor::needs_hand_back(flight.status().cause))
      flight.say(operators::command_kind::hand_back);
    if (flight.status().now == phase::paused)
      flight.say(operators::command_kind::resume);
    flight.run_for(1);
    flight.station().start_mission();
    (void)flight.run_until(is_under_way, 4);
  }
  return is_under_way();
}

} // namespace godwit::drill
