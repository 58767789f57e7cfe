#include "programs/godwit-drill/flights/disturbed_flight.hpp"

#include <utility>

#include "programs/godwit-drill/flight_simulation/flight_people.hpp"

namespace godwit::drill {
namespace {

using executor::phase;

bool is_on_last_item(const flight_simulation& flight) {
  const auto seen = flight.vehicle().describe();
  return seen.armed && seen.mission_count > 0 && seen.mission_current >= seen.mission_count - 1;
}

flight_outcome fly(const disturbed_flight& what, const flight_wishes& wishes) {
  const bool waits_for_start = what.part == phase::ready;
  auto wanted = what.wanted;
  wanted.starts_by_itself = !waits_for_start;
  watched_flight watched(std::move(wanted), wishes, what.name(), what.group());
  auto& flight = watched.flight();
  watched.so_far().skipped = reach(flight, what.part) ? what.disturb(watched) : "the flight has no such part";
  if (waits_for_start) {
    flight.run_for(5);
    watched.expect(flight.vehicle().describe().armed ? "it was armed although nobody had started it" : "");
    watched.expect(start_by_station(flight) ? "" : "a station could not start it");
  }
  return what.end == flight_end::as_planned ? watched.finish() : watched.finish_or_wait();
}

} // namespace

std::string disturbed_flight::group() const { return row_of(wanted.who, row.empty() ? io::name_of(part) : row); }

std::string disturbed_flight::name() const { return row_of(wanted.who, io::name_of(part)) + "/" + what; }

bool reach(flight_simulation& flight, phase part) {
  constexpr double within_s = 300;
  const auto is_there = [&] {
    const auto now = flight.status().now;
    return now == part || (part == phase::landing && now == phase::flying && is_on_last_item(flight));
  };
  return flight.run_until([&] { return is_there() || executor::is_at_rest(flight.status().now); }, within_s) &&
         is_there();
}

flight_case case_of(disturbed_flight each) {
  const auto name = each.name();
  const auto group = each.group();
  return {name, group, [each = std::move(each)](const flight_wishes& wishes) { return fly(each, wishes); }};
}

flight_simulation::options slow_flight(sim::personality who) {
  constexpr std::chrono::milliseconds delay{20}; // so that an upload takes its time
  const sim::line_settings each_way{.delay = delay};
  return {.who = who, .speed = 2, .stream_factor = 0.5, .line = {each_way, each_way}};
}

} // namespace godwit::drill
