#include "programs/godwit-sim/host/control_answers.hpp"

#include <algorithm>
#include <array>

#include <nlohmann/json.hpp>

#include "programs/godwit-sim/text_forms.hpp"

namespace godwit::sim {
namespace {

using json = nlohmann::json;

json failure(const std::string& sentence) { return {{"ok", false}, {"error", sentence}}; }

json counters_of(const line_counters& from) {
  return {{"sent", from.sent},
          {"delivered", from.delivered},
          {"lost", from.lost},
          {"duplicated", from.duplicated},
          {"reordered", from.reordered},
          {"late", from.late},
          {"damaged", from.damaged},
          {"cut", from.cut},
          {"overflowed", from.overflowed}};
}

json line_of(const hosted_vehicle& of) {
  return {{"faults", text_of(of.line().faults())},
          {"in", counters_of(of.line().counters(way::in))},
          {"out", counters_of(of.line().counters(way::out))}};
}

json link_json(const hosted_vehicle& of) {
  const auto counters = of.link_counters();
  return {{"uri", of.link_description()},
          {"peers", counters.peers},
          {"tx_bytes", counters.tx_bytes},
          {"rx_bytes", counters.rx_bytes},
          {"tx_dropped", counters.tx_dropped}};
}

json status_of(const hosted_vehicle& of) {
  const auto now = of.describe();
  return {{"vehicle", of.number() + 1},
          {"system", of.settings().vehicle.system},
          {"personality", io::name_of(of.settings().vehicle.who)},
          {"position",
           {{"latitude_deg", now.where.latitude_deg},
            {"longitude_deg", now.where.longitude_deg},
            {"altitude_m", now.where.altitude_m}}},
          {"heading_deg", now.heading_deg},
          {"ground_speed_mps", now.ground_speed_mps},
          {"mode", now.mode},
          {"armed", now.armed},
          {"in_air", now.in_air},
          {"mission",
           {{"state", now.mission_state},
            {"current", now.mission_current},
            {"count", now.mission_count},
            {"id", now.mission_id}}},
          {"battery_percent", now.battery_percent},
          {"has_position", now.has_position},
          {"world_ms", now.world_ms},
          {"line", line_of(of)},
          {"link", link_json(of)}};
}

json status(const vehicle_host& host, std::size_t first, std::size_t count) {
  auto vehicles = json::array();
  for (auto number = first; number < std::min(first + count, host.size()); ++number)
    vehicles.push_back(status_of(host.at(number)));
  return {{"ok", true}, {"vehicles", std::move(vehicles)}, {"count", host.size()}};
}

// The sentence about a key that means nothing here, or none.
std::string mistake_in_keys(const json& request) {
  constexpr std::array known{"do", "vehicle", "first", "id"};
  for (const auto& [key, value] : request.items())
    if (std::find(known.begin(), known.end(), key) == known.end())
      return in_quotes(key) + " is no part of a request; there are do, vehicle, first and id";
  return {};
}

// A vehicle by its number from 1; none when KEY is not there.
tl::expected<std::optional<std::size_t>, std::string> number_in(const json& request, const char* key,
                                                                const vehicle_host& host) {
  const auto found = request.find(key);
  if (found == request.end())
    return std::nullopt;
  const auto number = found->is_number_unsigned() ? found->get<std::uint64_t>() : 0;
  if (number < 1 || number > host.size())
    return tl::make_unexpected(in_quotes(key) + " is the number of a vehicle, from 1 to " +
                               std::to_string(host.size()));
  return static_cast<std::size_t>(number - 1);
}

json answer_to(vehicle_host& host, const std::string& what, std::optional<std::size_t> number, std::size_t first) {
  if (what == "status")
    return number ? status(host, *number, 1) : status(host, first, status_page);
  if (what == "quit") {
    host.end();
    return {{"ok", true}};
  }
  const auto fault = parse_fault(what);
  if (!fault)
    return failure(fault.error() + ", status or quit");
  host.apply(*fault, number);
  return {{"ok", true}, {"done", sentence_of(*fault)}};
}

} // namespace

json answer_control(vehicle_host& host, const json& request) {
  if (auto wrong = mistake_in_keys(request); !wrong.empty())
    return failure(wrong);
  const auto what = request.find("do");
  if (what == request.end() || !what->is_string())
    return failure("\"do\" is missing: what is to be done, such as \"status\"");
  const auto number = number_in(request, "vehicle", host);
  const auto first = number_in(request, "first", host);
  if (!number || !first)
    return failure(!number ? number.error() : first.error());
  return answer_to(host, what->get<std::string>(), *number, first->value_or(0));
}

} // namespace godwit::sim
