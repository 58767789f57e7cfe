#include "programs/godwitd/status_text.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>

#include "actors/domain/mission/utc_text.hpp"
#include "io/time_units.hpp"
#include "programs/common/printable.hpp"

namespace godwit::daemon {

namespace {

using json = nlohmann::json;

constexpr std::size_t key_width = 11; // of the names in front of the lines

std::string number(const json& part, const char* key) { return std::to_string(part.value(key, std::uint64_t{0})); }

std::string text(const json& part, const char* key) { return part.value(key, std::string()); }

std::string in_brackets(const std::string& reason) { return reason.empty() ? "" : " (" + reason + ")"; }

std::string run_line(const json& run) {
  const auto& seen = run.at("sightings");
  return "mission " + text(run, "mission_id") + ": " + text(run, "phase") + "; sightings: " + number(seen, "recorded") +
         " recorded, " + number(seen, "refused") + " refused, " + number(seen, "unreadable") + " unreadable";
}

// Of a mission that was asked for and not taken; the beginning of what came instead is for analysis.
std::string refused_text(const json& service) {
  const auto why = text(service, "refused");
  const auto sample = text(service, "refused_sample");
  return why.empty() ? "" : "; refused: " + why + (sample.empty() ? "" : "; it began with: " + sample);
}

std::string service_line(const json& service) {
  return text(service, "connection") + ", mission revision " + number(service, "revision") + ", map " +
         text(service, "pull") + "; outbox: " + number(service, "pending") + " pending, " +
         number(service, "orphaned") + " orphaned, " + number(service, "expired") + " expired" +
         (number(service, "lost_reports") == "0" ? "" : "; reports lost: " + number(service, "lost_reports")) +
         in_brackets(text(service, "last_error")) + refused_text(service);
}

std::string map_line(const json& map) {
  return text(map, "sync") + ", " + number(map, "objects") + " objects pulled, " + number(map, "seen_here") +
         " found or moved since; to deliver: " + number(map, "pending") + " and " + number(map, "taken") +
         " on their way, " + number(map, "orphaned") + " orphaned";
}

std::string vehicle_line(const json& vehicle) {
  const auto system = vehicle.value("system", 0);
  const bool is_unsigned = vehicle.value("signing_enabled", false) && vehicle.value("connected", false) &&
                           vehicle.value("signed_in", std::uint64_t{0}) == 0;
  return text(vehicle, "phase") + (system == 0 ? "" : ", system " + std::to_string(system)) +
         (is_unsigned ? ", its frames are not signed" : "") + in_brackets(text(vehicle, "reason"));
}

// What was dropped or refused, where there is any.
std::string ground_line(const json& ground) {
  auto result = ground.value("link_is_up", false) ? "up" : "down" + in_brackets(text(ground, "reason"));
  for (const auto& each : ground.value("stations", json::array()))
    result += ", station " + number(each, "system") + "/" + number(each, "component");
  std::string counts;
  constexpr const char* shown[] = {
      "passed_to_vehicle",      "passed_to_stations", "passing_refused",  "passing_dropped",
      "not_passed_to_stations", "acts_unanswered",    "signing_rejected", "texts_dropped",
      "transfers_dropped",      "stations_refused",   "dropped_in",       "dropped_out"};
  for (const auto& each : ground.value("counts", json::array()))
    for (const auto* const name : shown)
      if (text(each, "name") == name && each.value("count", std::uint64_t{0}) != 0)
        counts += (counts.empty() ? "; " : ", ") + std::string(name) + " " + number(each, "count");
  return result + counts;
}

std::string flight_line(const json& flight) {
  const auto mission = text(flight, "mission_id");
  auto result = text(flight, "sentence");
  if (!mission.empty())
    result += "; mission " + mission + " revision " + number(flight, "revision") + ": " + number(flight, "items_done") +
              " of " + number(flight, "items") + " items, " + number(flight, "reports") + " reports";
  if (const auto who = text(flight, "authority"); !who.empty() && who != "nobody")
    result += "; " + who + " has the vehicle";
  if (const auto mode = text(flight, "mode"); !mode.empty())
    result += "; " + mode + (flight.value("is_armed", false) ? ", armed" : ", disarmed");
  if (flight.value("preflight_report", 0U) != 0)
    result += "; preflight report " + number(flight, "preflight_report") + " waits for `ctl ack`";
  return result;
}

// "7d1c1f0e-... revision 2 of the service: waiting, 5 items (another mission is flown)"
std::string mission_line(const json& mission) {
  const auto id = text(mission, "mission_id");
  const auto is_told = [&](const char* key) { return mission.contains(key) && mission.at(key).is_number(); };
  auto result = id.empty() ? std::string("a mission") : id;
  if (is_told("revision"))
    result += " revision " + number(mission, "revision");
  const auto origin = text(mission, "origin");
  result += (origin == "unknown" ? "" : " (" + origin + ")") + ": " + text(mission, "place");
  if (const auto outcome = text(mission, "outcome"); !outcome.empty())
    result += ", " + outcome;
  if (is_told("items"))
    result += ", " + (is_told("items_done") ? number(mission, "items_done") + " of " : "") + number(mission, "items") +
              " items";
  return result + in_brackets(text(mission, "reason"));
}

std::string mission_lines(const json& missions) {
  std::string result;
  for (const auto& each : missions.value("list", json::array()))
    result += (result.empty() ? "" : "\n" + std::string(key_width, ' ')) + mission_line(each);
  return result.empty() ? "none is known" : result;
}

// "2 aircraft; the nearest: SWR123, 800 m to the north-east, 60 m higher, closest in 25 s at 120 m"
std::string traffic_line(const json& traffic) {
  const auto aircraft = traffic.value("aircraft", json::array());
  auto result = aircraft.empty()
                    ? std::string("no aircraft is heard")
                    : std::to_string(aircraft.size()) + " aircraft; the nearest: " + text(aircraft.front(), "sentence");
  for (const auto& each : traffic.value("warnings", json::array()))
    result += "\n" + std::string(key_width, ' ') + each.get<std::string>();
  return result;
}

std::string sightings_line(const json& seen) {
  return number(seen, "recorded") + " recorded, " + number(seen, "refused") + " refused, " +
         number(seen, "unreadable") + " unreadable" +
         (number(seen, "not_offered") == "0" ? "" : ", " + number(seen, "not_offered") + " not offered");
}

// "executor: running, wanted, essential, incarnation 2, 1 restarts; green; last crash: killed"
std::string actor_line(const json& actor) {
  auto result =
      text(actor, "name") + ": " + text(actor, "phase") + (actor.value("wanted", true) ? ", wanted" : ", not wanted") +
      (actor.value("essential", false) ? ", essential" : "") + ", incarnation " + number(actor, "incarnation") + ", " +
      number(actor, "restarts") + " restarts; " + text(actor, "health") + in_brackets(text(actor, "health_reason"));
  if (const auto crash = text(actor, "last_crash"); !crash.empty())
    result += "; last crash: " + crash;
  return result;
}

std::string actor_lines(const json& actors) {
  std::string result;
  for (const auto& each : actors.value("list", json::array()))
    result += (result.empty() ? "" : "\n" + std::string(key_width, ' ')) + actor_line(each);
  return result;
}

// "yellow: journal (the disk is slow), ground_port (down)"; all that is well is not named.
std::string health_line(const json& health) {
  const auto worst = text(health, "worst");
  if (worst == "green")
    return "all is well";
  std::string result = worst;
  const char* before = ": ";
  for (const auto& each : health.value("parts", json::array())) {
    if (text(each, "health") == "green")
      continue;
    result += std::exchange(before, ", ") + text(each, "part") +
              (text(each, "health") == worst ? "" : " " + text(each, "health")) + in_brackets(text(each, "reason"));
  }
  return result;
}

// "battery_low: return_home, done; overridden: operator_link (we walk over the hill)"
std::string failsafe_line(const json& failsafe) {
  std::string result = failsafe.value("in_flight", false) ? "watches" : "waits for a flight";
  if (failsafe.value("taken_over", false))
    result = "a person has the vehicle: it warns, and sends nothing";
  if (const auto reacts = failsafe.find("reacts"); reacts != failsafe.end() && reacts->is_object())
    result = text(*reacts, "why") + ": " + text(*reacts, "what") + ", " + text(*reacts, "stage");
  const char* before = "; overridden: ";
  for (const auto& each : failsafe.value("overridden", json::array()))
    result += std::exchange(before, ", ") + text(each, "scope") + in_brackets(text(each, "reason"));
  return result;
}

std::string seconds(const json& part, const char* key) {
  return std::to_string(part.value(key, std::int64_t{0}) / 1'000) + " s";
}

// "point 3: vehicle at 47.39810,8.54610, 90 %, moved, seen 12 s ago"
std::string point_line(const json& point) {
  const auto position = point.value("position", json::object());
  std::array<char, 48> place{};
  std::snprintf(place.data(), place.size(), "%.5f,%.5f", position.value("latitude_deg", 0.0),
                position.value("longitude_deg", 0.0));
  return "point " + number(point, "number") + ": " + text(point, "class_group") + " at " + place.data() + ", " +
         std::to_string(std::lround(100 * point.value("confidence", 0.0))) + " %" +
         (point.value("has_moved", false) ? ", moved" : "") + ", seen " + seconds(point, "seen_ago_ms") + " ago";
}

// "2 to decide about (ctl points), 5 wait for their turn; 1 confirmed, 0 declined, 3 passed over"
std::string points_line(const json& points) {
  const auto counts = points.value("counts", json::object());
  return std::to_string(points.value("shown", json::array()).size()) + " to decide about (ctl points), " +
         number(points, "waiting") + " wait for their turn; " + number(counts, "confirmed") + " confirmed, " +
         number(counts, "declined") + " declined, " + number(counts, "passed_over") + " passed over";
}

// "sees: 1280 x 720, 30 pictures a second, 0 dropped; 12 candidates, 3 sightings; started once"
// "connected to mqtts://fleet.example.org:8883 as rover-7; events: 0 wait, 412 delivered"
std::string fleet_line(const json& fleet) {
  const auto dropped = number(fleet, "dropped");
  const auto vehicle = text(fleet, "vehicle");
  const auto sentence = text(fleet, "sentence");
  auto result = fleet.value("is_connected", false) ? "connected to " + text(fleet, "broker") + " as " + vehicle
                : sentence.empty()                 ? "connecting to " + text(fleet, "broker") + " as " + vehicle
                                                   : vehicle + " is NOT connected: " + sentence;
  result += "; events: " + number(fleet, "waiting") + " wait, " + number(fleet, "delivered") + " delivered" +
            (dropped == "0" ? "" : ", " + dropped + " DROPPED");
  if (const auto next_ms = fleet.value("next_try_ms", std::int64_t{0}); next_ms != 0)
    result += "; tried again in " + std::to_string(next_ms / 1'000) + " s";
  return result;
}

std::string eyes_line(const json& eyes) {
  if (eyes.value("is_closed", false))
    return "closed: no mission with scanning is flown";
  const auto starts = eyes.value("starts", std::uint64_t{0});
  return (eyes.value("is_seeing", false) ? "sees: " : "does NOT see" + in_brackets(text(eyes, "sentence")) + ": ") +
         number(eyes, "width_px") + " x " + number(eyes, "height_px") + ", " +
         std::to_string(std::lround(eyes.value("frames_per_s", 0.0))) + " pictures a second, " +
         number(eyes, "dropped") + " dropped; " + number(eyes, "candidates") + " candidates, " +
         number(eyes, "sightings") + " sightings; godwit-eyes was started " +
         (starts == 1 ? "once" : std::to_string(starts) + " times");
}

struct part_row {
  const char* key;
  std::string (*line)(const json& part);
};

constexpr part_row parts[] = {
    {"health", health_line},   {"run", run_line},           {"flight", flight_line},       {"missions", mission_lines},
    {"traffic", traffic_line}, {"failsafe", failsafe_line}, {"operators", operators_line}, {"port", port_line},
    {"service", service_line}, {"map", map_line},           {"sightings", sightings_line}, {"points", points_line},
    {"eyes", eyes_line},       {"fleet", fleet_line},       {"vehicle", vehicle_line},     {"ground", ground_line},
    {"actors", actor_lines}};

} // namespace

std::string status_text(const json& answer) {
  std::string result;
  for (const auto& row : parts) {
    const auto part = answer.find(row.key);
    if (part == answer.end() || !part->is_object())
      continue;
    result += (result.empty() ? "" : "\n") + std::string(row.key) +
              std::string(key_width - std::char_traits<char>::length(row.key), ' ') +
              (part->contains("error") && !part->contains("sync") ? text(*part, "error") : row.line(*part));
  }
  return result;
}

std::string points_text(const json& answer) {
  std::string result;
  const auto add = [&](const std::string& line) { result += (result.empty() ? "" : "\n") + line; };
  for (const auto& each : answer.value("shown", json::array()))
    add(point_line(each) + "; decide within " + seconds(each, "decide_within_ms") + ": ctl confirm " +
        number(each, "number") + ", or decline");
  for (const auto& each : answer.value("confirmed", json::array()))
    add(point_line(each) + "; confirmed by " + text(each, "by"));
  const auto counts = answer.value("counts", json::object());
  add(number(answer, "waiting") + " wait for their turn; " + number(counts, "confirmed") + " were confirmed, " +
      number(counts, "declined") + " declined, " + number(counts, "passed_over") + " passed over; dropped: " +
      number(counts, "too_faint") + " too faint, " + number(counts, "too_old") + " too old, " +
      number(counts, "no_room") + " for want of room, " + number(counts, "mission_over") + " with their mission");
  return result;
}

std::string retry_text(const json& answer) {
  return number(answer, "tried_now") + " pending, tried now; " + number(answer, "queued") + " queued again";
}

namespace {

using json = nlohmann::json;

// To the second: that is as fine as people compare it.
std::string time_text(const json& row) {
  return mission::utc_text(row.value("at_ns", std::int64_t{0}) / ns_per_s * ns_per_s);
}

std::string who_text(const json& who) {
  const auto name = text(who, "name");
  const auto session = text(who, "session");
  return (name.empty() ? "nobody" : name) + " (" + (session.empty() ? "unknown" : text(who, "role") + ", " + session) +
         ")";
}

std::string row_text(const json& row) {
  auto result = time_text(row) + "  " + who_text(row.value("who", json::object())) + ": " + text(row, "what") + ": " +
                text(row, "outcome");
  if (const auto count = row.value("count", std::uint64_t{1}); count != 1)
    result += ", " + std::to_string(count) + " times";
  if (const auto reason = text(row, "reason"); !reason.empty())
    result += " (" + reason + ")";
  return result;
}

} // namespace

std::string audit_text(const json& answer) {
  std::string result;
  const auto rows = answer.value("rows", json::array());
  if (answer.value("has_older", false) && !rows.empty())
    result = "older rows: godwitd ctl audit --before " + std::to_string(rows.front().value("number", std::uint64_t{0}));
  for (const auto& row : rows)
    result += (result.empty() ? "" : "\n") + row_text(row);
  return result.empty() ? "there are no entries" : result;
}

std::string control_text(const json& answer) {
  const auto holder = text(answer, "holder");
  return holder.empty() ? "control is free" : holder + " has control";
}

std::string port_line(const json& part) {
  const auto fingerprint = text(part, "fingerprint");
  return text(part, "url") + (fingerprint.empty() ? "" : ", fingerprint " + fingerprint);
}

std::string operators_line(const json& part) {
  const auto control = part.find("control");
  std::string result = control != part.end() && control->is_object()
                           ? text(control->value("who", json::object()), "name") + " has control"
                           : "control is free";
  for (const auto& each : part.value("sessions", json::array()))
    result += ", " + who_text(each.value("who", json::object()));
  return result;
}

// As deep as control::ask_daemon reads.
nlohmann::json shown_answer(nlohmann::json answer) { // NOLINT(misc-no-recursion)
  if (answer.is_string())
    return programs::one_line(answer.get_ref<const std::string&>());
  if (answer.is_structured())
    for (auto& each : answer)
      each = shown_answer(std::move(each));
  return answer;
}

} // namespace godwit::daemon
