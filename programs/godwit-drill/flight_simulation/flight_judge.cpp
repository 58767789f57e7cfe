#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>

#include "actors/domain/geo/geodesic.hpp"
#include "actors/domain/mission/utc_text.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "programs/godwit-drill/flight_simulation/vehicle_modes.hpp"

namespace godwit::drill {
namespace {

namespace mavlink = io::mavlink;
using mission::progress_kind;

// The numbers rise by one, and nothing goes back.
std::string flaw_of_order(const std::vector<mission::progress_report>& reports) {
  std::uint32_t number = 0;
  std::uint32_t generation = 0;
  std::map<std::uint32_t, std::uint32_t> last_index;
  std::set<std::int32_t> complete;
  std::set<std::tuple<std::uint32_t, progress_kind, std::string>> told;
  for (const auto& each : reports) {
    const auto at = "report " + std::to_string(each.report_no);
    if (each.report_no != ++number)
      return at + " stands where " + std::to_string(number) + " should";
    if (each.generation < generation)
      return at + " is of an old generation";
    generation = each.generation;
    if (each.item_index && each.kind != progress_kind::skipped) {
      auto& last = last_index[generation];
      if (*each.item_index < last)
        return at + " goes back to an earlier item";
      last = *each.item_index;
    }
    if (each.item_id && !told.emplace(generation, each.kind, *each.item_id).second)
      return at + " tells of " + *each.item_id + " a second time";
    if (complete.contains(each.revision))
      return at + " comes after the one that completes the mission";
    if (each.kind == progress_kind::complete)
      complete.insert(each.revision);
  }
  return {};
}

std::string flaw_of_items(const std::vector<mission::progress_report>& reports, const mission::document& mission) {
  if (reports.empty() || reports.back().kind != progress_kind::complete)
    return "the mission is done, and the last report does not state it";
  std::set<std::string> told;
  for (const auto& each : reports)
    if (mission::settles_item(each.kind))
      told.insert(each.item_id.value_or(""));
  for (const auto& each : mission.items)
    if (!told.contains(mission::id_of(each)))
      return "item " + mission::id_of(each) + " was never reported";
  return {};
}

std::map<std::string, mission::position> waypoints_of(const mission::document& mission) {
  std::map<std::string, mission::position> result;
  for (const auto& each : mission.items)
    if (const auto* place = std::get_if<mission::waypoint>(&each))
      result.emplace(place->id, place->at);
  return result;
}

} // namespace

std::string flaw_of_reports(flight_simulation& flight) {
  if (flight.service().figures(sim::missions::row_kind::progress).differing != 0)
    return "a report came again with another content";
  constexpr unsigned wrong_content = 422; // no fault of a drill answers so
  if (flight.service().answers_to_reports(wrong_content) != 0)
    return "a report names an item that the service does not know";
  const auto reports = flight.reports();
  auto flaw = flaw_of_order(reports);
  if (flaw.empty() && flight.status().now == executor::phase::done)
    flaw = flaw_of_items(reports, flight.service().mission(flight.mission_id()));
  return flaw;
}

std::string flaw_of_mission(flight_simulation& flight, const std::string& mission_id) {
  const auto reports = flight.reports_of(mission_id);
  auto flaw = flaw_of_order(reports);
  return flaw.empty() ? flaw_of_items(reports, flight.service().mission(mission_id)) : flaw;
}

report_counts count_reports(flight_simulation& flight) {
  report_counts result;
  std::set<std::uint32_t> numbers;
  std::set<std::tuple<std::uint32_t, progress_kind, std::string>> told;
  std::set<std::string> items;
  for (const auto& each : flight.reports()) {
    const bool is_new = numbers.insert(each.report_no).second;
    const auto item = each.item_id.value_or("");
    if (!is_new || (each.item_id && !told.emplace(each.generation, each.kind, item).second))
      ++result.doubled;
    if (mission::settles_item(each.kind))
      items.insert(item);
  }
  if (!numbers.empty())
    result.lost = *numbers.rbegin() - numbers.size();
  if (flight.status().now == executor::phase::done)
    for (const auto& each : flight.service().mission(flight.mission_id()).items)
      result.lost += items.contains(mission::id_of(each)) ? 0 : 1;
  return result;
}

std::string flaw_of_place(flight_simulation& flight) {
  if (flight.status().now != executor::phase::done)
    return {};
  constexpr double near_m = 15;        // of where a mission leads; actors/domain has the same for its end
  constexpr double near_plane_m = 150; // a fixed wing lands by a long approach
  const auto seen = flight.vehicle().describe();
  const auto mission = flight.service().mission(flight.mission_id());
  auto wanted = mission.return_point.value_or(mission::position{});
  if (const auto* place = std::get_if<mission::waypoint>(&mission.items.back()))
    wanted = place->at;
  else if (const auto* landing = std::get_if<mission::land>(&mission.items.back()))
    wanted = landing->at;
  const auto away_m = geo::distance_m(geo::point{seen.where.latitude_deg, seen.where.longitude_deg},
                                      geo::point{wanted.latitude, wanted.longitude});
  if (seen.in_air)
    return "the mission is done, and the vehicle is in the air";
  if (away_m > (flight.who() == sim::personality::plane ? near_plane_m : near_m))
    return "the mission is done, and the vehicle stands " + std::to_string(static_cast<int>(away_m)) +
           " m from where it leads";
  return {};
}

std::string flaw_of_truth(flight_simulation& flight) {
  if (std::ranges::any_of(flight.orders(), &vehicle_order::clears_armed))
    return "the plan was taken from a vehicle that was armed";
  if (flight.sent_without_intent())
    return "a plan or a start went out before its intent was on the disk";
  constexpr double near_m = 20;        // an autopilot goes on within this of a waypoint
  constexpr double near_plane_m = 120; // and a fixed wing turns before it
  constexpr std::int64_t between_looks_ns = 2 * flight_track::look_every_ns;
  const bool is_plane = flight.who() == sim::personality::plane;
  auto places = waypoints_of(flight.first_mission());
  places.merge(waypoints_of(flight.service().mission(flight.mission_id())));
  for (const auto& each : flight.reports()) {
    const auto place = places.find(each.item_id.value_or(""));
    if (each.kind != progress_kind::reached || place == places.end())
      continue;
    const auto told_ns = mission::time_of_utc_text(each.at).value_or(0) - daemon_process::wall_began_ns;
    const auto at_ns = flight.was_clock_set() ? flight.now_ns() : told_ns;
    if (!flight.track().was_near(place->second, is_plane ? near_plane_m : near_m, at_ns + between_looks_ns))
      return "report " + std::to_string(each.report_no) + " says that " + place->first +
             " was reached, and the vehicle had not been there";
  }
  return {};
}

std::string flaw_of_end(const flight_simulation& flight) {
  const auto& at = flight.status();
  if (executor::is_at_rest(at.now) || has_nothing_to_fly(flight))
    return {};
  if (at.now != executor::phase::paused)
    return "it neither ends nor waits for a person";
  return at.reason.empty() ? "it is paused without a reason" : "";
}

bool moves_vehicle(const vehicle_order& order) {
  constexpr std::array harmless{mavlink::number(mavlink::mav_cmd::set_message_interval),
                                mavlink::number(mavlink::mav_cmd::request_message)};
  if (order.puts_to_rest)
    return false;
  switch (order.message_id) {
  case mavlink::command_long::message_id:
  case mavlink::command_int::message_id:
    return std::ranges::find(harmless, order.command) == harmless.end();
  case mavlink::set_mode::message_id:
  case mavlink::mission_set_current::message_id:
  case mavlink::mission_count::message_id:
  case mavlink::mission_clear_all::message_id:
  case mavlink::param_set::message_id:
    return true;
  default:
    return false;
  }
}

int moves_since(const flight_simulation& flight, std::int64_t since_ns) {
  return static_cast<int>(std::ranges::count_if(
      flight.orders(), [&](const vehicle_order& each) { return each.at_ns >= since_ns && moves_vehicle(each); }));
}

int starts_since(const flight_simulation& flight, std::int64_t since_ns) {
  return static_cast<int>(std::ranges::count_if(flight.orders(), [&](const vehicle_order& each) {
    const bool is_transfer = each.message_id == mavlink::mission_count::message_id ||
                             each.message_id == mavlink::mission_clear_all::message_id;
    return each.at_ns >= since_ns && moves_vehicle(each) && !is_transfer;
  }));
}

int missions_started_since(const flight_simulation& flight, std::int64_t since_ns) {
  return static_cast<int>(std::ranges::count_if(flight.orders(), [&](const vehicle_order& each) {
    const bool begins =
        each.command == mavlink::number(mavlink::mav_cmd::mission_start) || each.mode == mission_mode(flight.who());
    return each.at_ns >= since_ns && begins;
  }));
}

} // namespace godwit::drill
