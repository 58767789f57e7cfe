#include "programs/godwit-sim/missions_options.hpp"

#include <cmath>
#include <filesystem>
#include <utility>

#include "actors/domain/mission/convert/convert.hpp"
#include "actors/domain/mission/read.hpp"
#include "io/http/secret_file.hpp"
#include "programs/godwit-sim/commands.hpp"
#include "programs/godwit-sim/host/control_port.hpp"
#include "programs/godwit-sim/missions/fault.hpp"
#include "programs/godwit-sim/missions/synthetic_map.hpp"
#include "programs/godwit-sim/text_forms.hpp"

namespace godwit::sim {
namespace {

using done = tl::expected<void, std::string>;

constexpr std::size_t max_certificate_bytes = 256 * 1024; // a chain of some certificates

done read_listen(const std::string& text, missions::service_settings& to) {
  const auto where = io::link::parse_uri("tcpin://" + text);
  if (!where || where->host.empty())
    return in_option("--listen", in_quotes(text) + " is no place to listen at: HOST:PORT, such as 127.0.0.1:8443; "
                                                   "port 0 is any free one");
  to.host = where->host;
  to.port = where->port;
  return {};
}

done read_identity(const char* option, const std::string& text, std::optional<missions::identity>& to) {
  if (text.empty())
    return {};
  const auto parts = parts_of(text, ',');
  if (parts.size() != 2 || parts[0].empty() || parts[1].empty())
    return in_option(option, in_quotes(text) + " is no pair of files: CERT,KEY, both in PEM");
  auto certificate = missions::read_text_file(std::string(parts[0]), max_certificate_bytes);
  if (!certificate)
    return in_option(option, certificate.error());
  const auto key =
      io::http::load_secret_file(std::string(parts[1]), io::http::max_key_bytes, io::http::errc::invalid_settings);
  if (!key)
    return in_option(option, key.error().message());
  to = missions::identity{*std::move(certificate), std::string(key->revealed())};
  return {};
}

done read_token(const char* option, const std::string& file, std::string& to) {
  const auto token = io::http::load_token(file);
  if (!token)
    return in_option(option, token.error().message());
  to = token->revealed();
  return {};
}

done read_mission(const std::string& file, bool allow_partial, missions_request& to) {
  const auto format = mission::format_of_name(file);
  if (!format)
    return in_option("--mission", file + " is no file of a mission: .json (ours), .plan (QGroundControl), .waypoints");
  const auto text = missions::read_text_file(file, mission::max_mission_bytes);
  if (!text)
    return in_option("--mission", text.error());
  mission::import_options how;
  how.allow_partial = allow_partial;
  auto read = mission::import_mission(*text, *format, how);
  if (!read) {
    const bool is_partial = read.error().error.code == mission::document_errc::lossy;
    return in_option("--mission", file + ": " + read.error().message() +
                                      (is_partial ? "\n--allow-partial takes what can be taken" : ""));
  }
  if (!read->losses.empty())
    to.notes.push_back(file + ": not carried over:\n" + read->losses.message());
  to.notes.push_back("mission " + read->mission.mission_id + ": " + std::to_string(read->mission.items.size()) +
                     " items of " + std::filesystem::path(file).filename().string());
  to.settings.missions.push_back(std::move(read->mission));
  return {};
}

// Where the first mission leads back to, or was planned for.
mission::vertex middle_of_map(const mission::document& mission) {
  if (mission.return_point)
    return {mission.return_point->latitude, mission.return_point->longitude};
  return mission.planned_home ? mission::vertex{mission.planned_home->latitude, mission.planned_home->longitude}
                              : mission::vertex{};
}

done read_map(const missions_arguments& given, missions::service_settings& to) {
  if (given.map_objects > missions::max_synthetic_objects)
    return in_option("--map-objects", "at most " + std::to_string(missions::max_synthetic_objects));
  to.map.count = given.map_objects;
  const auto middle = middle_of_map(to.missions.front());
  to.map.latitude = middle.latitude;
  to.map.longitude = middle.longitude;
  if (given.around.empty())
    return {};
  const auto parts = parts_of(given.around, ',');
  const auto latitude = read_number(parts.front());
  const auto longitude = read_number(parts.back());
  if (parts.size() != 2 || !latitude || !longitude || std::abs(*latitude) > 89 || std::abs(*longitude) > 180)
    return in_option("--around", in_quotes(given.around) + " is no place: LATITUDE,LONGITUDE in degrees");
  to.map.latitude = *latitude;
  to.map.longitude = *longitude;
  return {};
}

done read_faults(const missions_arguments& given, missions::service_settings& to) {
  for (const auto& each : given.faults)
    if (const auto rule = missions::parse_fault_rule(each); !rule)
      return in_option("--fault", rule.error());
  to.faults = given.faults;
  if (given.control.empty())
    return {};
  auto where = parse_control_place(given.control);
  if (!where)
    return in_option("--control", where.error());
  to.control = *std::move(where);
  return {};
}

done read_missions(const missions_arguments& given, missions_request& to) {
  if (given.missions.empty())
    return in_option("--mission", "name at least one file of a mission");
  for (const auto& each : given.missions)
    if (auto read = read_mission(each, given.allow_partial, to); !read)
      return read;
  return read_map(given, to.settings);
}

} // namespace

tl::expected<missions_request, std::string> read(const missions_arguments& given) {
  missions_request wanted;
  auto& settings = wanted.settings;
  settings.database = given.database;
  settings.seed = given.seed;
  const auto steps =
      read_listen(given.listen, settings)
          .and_then([&] { return read_identity("--tls", given.tls, settings.tls); })
          .and_then([&] { return read_identity("--wrong-host-tls", given.wrong_host_tls, settings.wrong_host_tls); })
          .and_then([&] { return read_token("--token-file", given.token_file, settings.token); })
          .and_then([&]() -> done {
            return given.foreign_token_file.empty()
                       ? done()
                       : read_token("--foreign-token-file", given.foreign_token_file, settings.foreign_token);
          })
          .and_then([&] { return read_missions(given, wanted); })
          .and_then([&] { return read_faults(given, settings); });
  if (!steps)
    return tl::unexpected(steps.error());
  return wanted;
}

} // namespace godwit::sim
