#include "programs/godwitd/settings.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <sstream>
#include <utility>

#include "actors/domain/mission/convert/convert.hpp"
#include "actors/domain/uuid/uuid.hpp"
#include "actors/ground_port/passing/table.hpp"
#include "io/fields/field_table.hpp"
#include "io/mavlink/messages/position.hpp"
#include "io/video/camera_uri.hpp"
#include "programs/common/printable.hpp"
#include "programs/godwitd/configuration.hpp"
#include "programs/godwitd/open_line.hpp"

namespace godwit::daemon {
namespace {

using json = nlohmann::json;
using checked = tl::expected<void, std::string>;

#ifdef GODWIT_HAS_EYES
constexpr bool has_eyes = true;
#else
constexpr bool has_eyes = false;
#endif

std::string text(const json& section, const char* key) { return section.at(key).get<std::string>(); }

std::chrono::milliseconds ms(const json& value) { return std::chrono::milliseconds(value.get<std::int64_t>()); }

tl::unexpected<std::string> wrong(std::string_view option, const std::string& sentence) {
  return tl::make_unexpected(all_names_of(option) + ": " + sentence);
}

// The path at PLACE, or ENDING instead of the journal's.
std::string beside_journal(const json& configuration, const char* section, const char* ending,
                           const char* key = "path") {
  auto given = text(configuration.at(section), key);
  return given.empty() ? std::filesystem::path(journal_path(configuration)).replace_extension(ending).string() : given;
}

io::http::settings http_settings(const json& service) {
  io::http::settings result;
  result.base_url = text(service, "url");
  result.ca_file = text(service, "ca_file");
  result.certificate_file = text(service, "certificate_file");
  result.key_file = text(service, "key_file");
  result.proxy = text(service, "proxy");
  result.token_file = text(service, "token_file");
  result.connect_timeout = ms(service.at("connect_timeout_ms"));
  result.read_timeout = ms(service.at("read_timeout_ms"));
  result.total_timeout = ms(service.at("total_timeout_ms"));
  return result;
}

bool is_vehicle_name(const std::string& text) {
  constexpr std::size_t longest = 64;
  return !text.empty() && text.size() <= longest && std::ranges::all_of(text, [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '-' ||
           c == '_';
  });
}

// One mission, or the next ones of a vehicle.
checked read_mission_of_service(const json& configuration, daemon_settings& to) {
  to.vehicle_id = text(configuration.at("service"), "vehicle");
  if (!to.vehicle_id.empty() && !is_vehicle_name(to.vehicle_id))
    return wrong("vehicle-id", "is \"" + programs::printable(to.vehicle_id) +
                                   "\"; it has 1 to 64 letters, digits, points, - and _, such as bird-1");
  const bool takes_next = to.mission_id.empty() && !to.vehicle_id.empty();
  if (takes_next && !(to.flies && to.sightings_file.empty()))
    return wrong("mission-id", "is missing: a run on the ground, and a file of sightings, belong to one mission");
  if (!takes_next && !ids::is_uuid(to.mission_id))
    return wrong(
        "mission-id",
        (to.mission_id.empty() ? "is missing" : "is \"" + to.mission_id + "\"") +
            "; it is a UUID in small letters, such as 7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42. Or name the vehicle "
            "with --vehicle-id, and its next mission is asked for");
  return {};
}

// A run on the ground takes no missions of ground stations, and sightings belong to a mission that is known before.
bool stations_may_bring(const json& configuration, const daemon_settings& so_far) {
  return so_far.flies && so_far.sightings_file.empty() && !text(configuration.at("ground"), "uri").empty();
}

void read_what_to_do(const json& configuration, daemon_settings& to) {
  const auto& sightings = configuration.at("sightings");
  to.once = sightings.at("once").get<bool>();
  to.sightings_file = text(sightings, "file");
  to.flies = !configuration.at("flight").at("ground_run").get<bool>() && !to.once;
}

checked read_allowed_commands(const std::string& listed, daemon_settings& to) {
  std::istringstream names(listed);
  for (std::string each; names >> each;) {
    const auto number = mission::command_number(each);
    if (!number)
      return wrong("flight", "flight.allowed_commands: no command has the name or number " + each);
    if (mission::is_never_carried(*number))
      return wrong("flight", "flight.allowed_commands: no mission may hold " + each +
                                 ", which stops motors, changes the mode, pauses or starts a mission");
    if (to.allowed_commands.size() == mission::max_allowed_commands)
      return wrong("flight",
                   "flight.allowed_commands: more than " + std::to_string(mission::max_allowed_commands) + " commands");
    to.allowed_commands.push_back(*number);
  }
  return {};
}

checked read_source(const json& configuration, daemon_settings& to) {
  if (const auto allowed = read_allowed_commands(text(configuration.at("flight"), "allowed_commands"), to); !allowed)
    return allowed;
  const auto& mission = configuration.at("mission");
  to.mission_id = text(mission, "id");
  to.mission_file = text(mission, "file");
  to.allow_partial = mission.at("allow_partial").get<bool>();
  const auto service = http_settings(configuration.at("service"));
  if (!to.mission_file.empty()) {
    if (!service.base_url.empty() || !to.mission_id.empty())
      return wrong("mission", "a mission comes from a file or from a service, not from both: leave this out, or "
                              "--service and --mission-id");
    if (!mission::format_of_name(to.mission_file))
      return wrong("mission", to.mission_file + " has none of the endings " + mission::known_endings);
    return {};
  }
  if (service.base_url.empty() && to.mission_id.empty() && stations_may_bring(configuration, to))
    return {};
  if (service.base_url.empty())
    return wrong("service", "is missing: name the missions service, a file with --mission, or with --ground a line for "
                            "ground stations that upload missions");
  if (auto named = read_mission_of_service(configuration, to); !named)
    return named;
  if (const auto known = io::http::checked(service); !known)
    return wrong("service", known.error().message());
  to.service = service;
  return {};
}

void read_delivery(const json& configuration, daemon_settings& to) {
  const auto& delivery = configuration.at("delivery");
  const auto& service = configuration.at("service");
  to.client.max_tries = delivery.at("max_tries").get<int>();
  to.client.poll_wait = std::chrono::seconds(delivery.at("poll_wait_s").get<std::int64_t>());
  to.client.page_limit = delivery.at("page_rows").get<std::uint32_t>();
  to.client.batch_limit = delivery.at("batch_rows").get<std::uint32_t>();
  to.client.call_timeout = ms(service.at("read_timeout_ms"));
  to.client.total_timeout = ms(service.at("total_timeout_ms"));
}

checked read_vehicle(const json& vehicle, daemon_settings& to) {
  const auto where = text(vehicle, "uri");
  if (where.empty())
    return wrong("vehicle", "is missing: name the link to the autopilot, such as udpin://0.0.0.0:14550 or "
                            "serial:///dev/ttyAMA0:921600");
  auto parsed = io::link::parse_uri(where);
  if (!parsed)
    return wrong("vehicle", parsed.error());
  to.vehicle = *std::move(parsed);
  to.vehicle_system = vehicle.at("system").get<std::uint8_t>();
  to.signing_key_file = text(vehicle, "key_file");
  to.vehicle_line_is_secure = vehicle.at("secure").get<bool>();
  to.flight.checks.open_line = open_line(to.vehicle, !to.signing_key_file.empty());
  if (to.vehicle_line_is_secure && !stays_in_vehicle(to.vehicle))
    return tl::make_unexpected("vehicle.secure: " + to.vehicle.text() +
                               " goes over a network, where others can listen; only a serial line, or an address of "
                               "this computer, can be marked secure");
  to.link.command_timeout_ms = vehicle.at("command_timeout_ms").get<std::int64_t>();
  to.link.watch.lost_after_ms = vehicle.at("lost_after_ms").get<std::int64_t>();
  if (vehicle.at("as_ground_station").get<bool>())
    to.link.as = vehicle_link::ground_station_identity;
  return {};
}

checked read_flight(const json& configuration, daemon_settings& to) {
  const auto& flight = configuration.at("flight");
  to.allow_crash = flight.at("allow_crash").get<bool>();
  to.flight.mission_id = to.mission_id;
  to.flight.vehicle_id = to.vehicle_id;
  to.flight.has_service = to.service.has_value();
  to.flight.start = io::value_of<executor::start_policy>(text(flight, "start")).value();
  to.flight.arm_on_start = flight.at("arm_on_start").get<bool>();
  to.flight.takeoff_again = io::value_of<executor::start_policy>(text(flight, "takeoff_again")).value();
  to.flight.limits.max_altitude_m = flight.at("max_altitude_m").get<double>();
  to.flight.limits.max_distance_m = flight.at("max_distance_m").get<double>();
  to.flight.close_traffic = {flight.at("traffic_distance_m").get<double>(), flight.at("traffic_height_m").get<double>(),
                             flight.at("traffic_time_s").get<double>()};
  to.flight.own_loiter_radius_m = flight.at("own_loiter_radius_m").get<double>();
  to.flight.drain_percent_per_min = flight.at("drain_percent_per_min").get<double>();
  to.flight.return_altitude_m = flight.at("return_altitude_m").get<double>();
  to.flight.fence_margin_m = flight.at("fence_margin_m").get<double>();
  to.flight.allow_partial = to.allow_partial;
  to.flight.allowed_commands = to.allowed_commands;
  to.flight.brings_last_line = flight.at("last_line").get<bool>();
  to.flight.marks_landings = flight.at("marks_landings").get<bool>();
  to.flight.refused_inserts = io::value_of<executor::refusal_policy>(text(flight, "refused_inserts")).value();
  to.flight.changes_need_service = flight.at("changes_need_service").get<bool>();
  to.flight.service_wait_ms = flight.at("service_wait_ms").get<std::int64_t>();
  to.flight.deleted_mission = io::value_of<executor::deletion_policy>(text(flight, "deleted_mission")).value();
  to.flight.failsafe_gone = io::value_of<executor::failsafe_gone_policy>(text(flight, "failsafe_gone")).value();
  to.flight.checks.min_satellites = flight.at("min_satellites").get<std::int32_t>();
  to.flight.checks.starts_by_itself = to.flight.start == executor::start_policy::automatic;
  to.flight.checks.is_operator_session_required = flight.at("needs_operator").get<bool>();
  to.flight.checks.asks_for_straight_return = flight.at("ask_straight_return").get<bool>();
  to.flight.checks.battery_margin_percent = flight.at("battery_margin_percent").get<std::int32_t>();
  if (to.flight.start == executor::start_policy::automatic && !to.flight.arm_on_start)
    return wrong("start", "automatic starts a flight without a person, and so has to be allowed to arm: set "
                          "--arm-on-start as well, or leave it on_command");
  return {};
}

checked read_failsafe(const json& given, daemon_settings& to) {
  auto& result = to.failsafe;
  result.operator_link = io::value_of<failsafe::operator_link_policy>(text(given, "operator_link")).value();
  result.link_degraded_ms = given.at("link_degraded_ms").get<std::int64_t>();
  result.link_lost_ms = given.at("link_lost_ms").get<std::int64_t>();
  result.battery_low_percent = given.at("battery_low_percent").get<std::int32_t>();
  result.battery_critical_percent = given.at("battery_critical_percent").get<std::int32_t>();
  result.following_extra_ms = given.at("following_extra_ms").get<std::int64_t>();
  result.moving_mps = given.at("moving_mps").get<double>();
  result.failsafe_in_manual = given.at("in_manual").get<bool>();
  to.flight.checks.battery_return_percent = result.battery_low_percent;
  to.flight.checks.battery_critical_percent = result.battery_critical_percent;
  if (const auto objection = failsafe::objection_to(result))
    return tl::make_unexpected("failsafe: " + *objection);
  return {};
}

checked read_ground(const json& ground, daemon_settings& to) {
  const auto where = text(ground, "uri");
  to.ground_key_file = text(ground, "key_file");
  to.speaks_as_autopilot = ground.at("as_autopilot").get<bool>();
  to.flight.shows_home = to.speaks_as_autopilot;
  to.unsigned_stations = io::value_of<godwit::operators::role>(text(ground, "unsigned_role")).value();
  to.ground_passes = text(ground, "passes") == "all";
  to.ground_max_items = ground.at("max_items").get<int>();
  std::istringstream names(text(ground, "also_passes"));
  for (std::string each; names >> each;) {
    if (!ground_port::passing::is_for_setting(each))
      return wrong("ground", "ground.also_passes: nothing is passed on by the name " + each);
    to.ground_also_passes.push_back(each);
  }
  if (where.empty())
    return {};
  auto parsed = io::link::parse_uri(where);
  if (!parsed)
    return wrong("ground", parsed.error());
  to.ground = *std::move(parsed);
  return {};
}

checked read_operators(const json& given, const std::string& journal, daemon_settings& to) {
  const auto where = text(given, "listen");
  if (where.empty())
    return {};
  auto listen = operator_port::read_listen(where);
  if (!listen)
    return wrong("operator-listen", listen.error());
  auto hosts = operator_port::read_hosts(text(given, "hosts"));
  if (!hosts)
    return wrong("operator-listen", "operator.hosts: " + hosts.error());
  to.operators = *std::move(listen);
  to.operators->hosts = *std::move(hosts);
  to.operators->tiles = text(given, "tiles");
  to.operators->docs = text(given, "docs");
  to.operators->uses_tls = !to.operators->is_local || given.at("tls").get<bool>();
  to.operators->certificate_file = text(given, "certificate");
  to.operators->key_file = text(given, "key");
  if (to.operators->certificate_file.empty() != to.operators->key_file.empty())
    return wrong("operator-listen", "operator.certificate and operator.key belong together: name both, or neither");
  if (!to.operators->is_local && !to.flies)
    return wrong("operator-listen", to.operators->host + " is reached from other computers, and a run on the ground "
                                                         "knows no operators: name 127.0.0.1 or [::1]");
  to.operators->identity_file = std::filesystem::path(journal).replace_extension(".tls").string();
  return {};
}

void read_map(const json& configuration, daemon_settings& to) {
  const auto& map = configuration.at("map");
  to.map.store.file.path = map_path(configuration);
  to.map.store.rules.match_within_m = map.at("match_within_m").get<double>();
  to.map.store.rules.moved_above_m = map.at("moved_above_m").get<double>();
}

void read_accounts(const json& configuration, daemon_settings& to) {
  const auto& given = configuration.at("operator");
  to.accounts_file = accounts_path(configuration);
  to.pictures_folder = std::filesystem::path(journal_path(configuration)).replace_extension(".pictures").string();
  to.sessions.session_idle_s = given.at("session_idle_min").get<std::int64_t>() * 60;
  to.sessions.session_most_s = given.at("session_most_h").get<std::int64_t>() * 3'600;
}

checked read_scan(const json& scan, daemon_settings& to) {
  to.flight.scans = io::value_of<executor::scan_policy>(text(scan, "missions")).value();
  to.scan.min_confidence = scan.at("min_confidence").get<double>();
  to.scan.shown_a_minute = scan.at("shown_a_minute").get<std::uint32_t>();
  to.scan.window_ms = scan.at("window_s").get<std::int64_t>() * 1'000;
  to.scan.merge_within_m = scan.at("merge_within_m").get<double>();
  to.scan.keep_ms = scan.at("keep_s").get<std::int64_t>() * 1'000;
  to.scan.pass_confidence = scan.at("pass_confidence").get<double>();
  std::istringstream names(text(scan, "looks_for"));
  for (std::string each; names >> each;)
    to.scan.looks_for.push_back(each);
  const auto objection = scan_controller::objection_to(to.scan);
  return objection ? tl::make_unexpected("scan.looks_for: " + *objection) : checked();
}

checked read_camera(const json& camera, daemon_settings& to) {
  movement_detector::settings result;
  result.uri = text(camera, "uri");
  if (result.uri.empty())
    return {};
  if constexpr (!has_eyes)
    return wrong("camera",
                 "this godwitd was built without the detector (GODWIT_EYES=OFF); leave it out, or build it with them");
  if (const auto known = io::video::parse_camera_uri(result.uri); !known)
    return wrong("camera", known.error());
  result.width_px = camera.at("width_px").get<std::int32_t>();
  result.height_px = camera.at("height_px").get<std::int32_t>();
  result.focal_px = camera.at("focal_px").get<double>();
  result.k1 = camera.at("k1").get<double>();
  result.k2 = camera.at("k2").get<double>();
  result.mount_yaw_deg = camera.at("mount_yaw_deg").get<double>();
  result.mount_pitch_deg = camera.at("mount_pitch_deg").get<double>();
  result.mount_roll_deg = camera.at("mount_roll_deg").get<double>();
  result.is_on_gimbal = camera.at("on_gimbal").get<bool>();
  result.attitude_sd_deg = camera.at("attitude_sd_deg").get<double>();
  result.min_height_m = camera.at("min_height_m").get<double>();
  result.max_off_nadir_deg = camera.at("max_off_nadir_deg").get<double>();
  result.class_group = text(camera, "class_group");
  result.min_confidence = camera.at("min_confidence").get<double>();
  result.record_folder = text(camera, "record_folder");
  result.record_max_mb = camera.at("record_max_mb").get<std::int64_t>();
  result.model = text(camera, "model");
  if (const auto objection = movement_detector::objection_to(result))
    return tl::make_unexpected("camera." + *objection);
  to.eyes_program = text(camera, "program");
  // A pose is of use when it is near to its picture in time.
  constexpr std::int32_t attitude_interval_ms = 100;
  for (auto& each : to.link.streams)
    if (each.message == io::mavlink::attitude::message_id)
      each.interval_ms = std::min(each.interval_ms, attitude_interval_ms);
  if (result.is_on_gimbal)
    to.link.streams.push_back({.message = io::mavlink::gimbal_device_attitude_status::message_id,
                               .interval_ms = attitude_interval_ms,
                               .is_optional = true}); // it may come by itself, or from the gimbal
  to.scan.watches_view = true;
  to.camera = std::move(result);
  return {};
}

checked read_fleet(const json& given, daemon_settings& to) {
  fleet_link::settings result;
  const auto where = text(given, "broker");
  if (where.empty())
    return {};
  if (!to.flies)
    return wrong("broker", "a run on the ground has nothing for a broker; leave it out");
  auto parsed = io::mqtt::parse_broker_uri(where);
  if (!parsed)
    return wrong("broker", parsed.error());
  result.broker = *std::move(parsed);
  result.vehicle = text(given, "vehicle");
  result.username = text(given, "username");
  result.password_file = text(given, "password_file");
  result.ca_file = text(given, "ca_file");
  result.certificate_file = text(given, "certificate_file");
  result.key_file = text(given, "key_file");
  result.interval_ms = given.at("interval_ms").get<std::int64_t>();
  if (const auto objection = fleet_link::objection_to(result))
    return tl::make_unexpected("telemetry." + *objection);
  to.fleet = std::move(result);
  return {};
}

log_settings log_from(const json& log) {
  log_settings result;
  result.file = text(log, "file");
  result.format = log.at("format") == "json" ? log_format::json : log_format::text;
  const auto level = text(log, "level");
  result.level = level == "info" ? log_level::info : level == "warning" ? log_level::warning : log_level::error;
  return result;
}

start_limits restarts_from(const json& restarts) {
  return {restarts.at("max_abnormal_ends").get<std::size_t>(),
          std::chrono::seconds(restarts.at("within_s").get<std::int64_t>())};
}

} // namespace

std::string journal_path(const json& configuration) { return text(configuration.at("journal"), "path"); }

std::string map_path(const json& configuration) { return beside_journal(configuration, "map", ".map.db"); }

std::string control_path(const json& configuration) { return beside_journal(configuration, "control", ".control"); }

std::string accounts_path(const json& configuration) {
  return beside_journal(configuration, "operator", ".operators", "accounts");
}

tl::expected<daemon_settings, std::string> settings_from(const json& configuration) {
  daemon_settings result;
  result.process = runtime::options_from(configuration);
  result.process.trace->program = "godwitd";
  result.process.trace->about["settings"] = programs::without_secrets(configuration).dump();
  if (configuration.at("trace").at("links").get<bool>())
    result.link_log = share_of(*result.process.trace);
  read_what_to_do(configuration, result);
  if (auto source = read_source(configuration, result); !source)
    return tl::make_unexpected(std::move(source.error()));
  if (auto vehicle = read_vehicle(configuration.at("vehicle"), result); !vehicle)
    return tl::make_unexpected(std::move(vehicle.error()));
  if (auto flight = read_flight(configuration, result); !flight)
    return tl::make_unexpected(std::move(flight.error()));
  if (auto failsafe = read_failsafe(configuration.at("failsafe"), result); !failsafe)
    return tl::make_unexpected(std::move(failsafe.error()));
  if (auto ground = read_ground(configuration.at("ground"), result); !ground)
    return tl::make_unexpected(std::move(ground.error()));
  if (auto operators = read_operators(configuration.at("operator"), journal_path(configuration), result); !operators)
    return tl::make_unexpected(std::move(operators.error()));
  read_map(configuration, result);
  read_accounts(configuration, result);
  if (auto scan = read_scan(configuration.at("scan"), result); !scan)
    return tl::make_unexpected(std::move(scan.error()));
  if (auto camera = read_camera(configuration.at("camera"), result); !camera)
    return tl::make_unexpected(std::move(camera.error()));
  if (auto fleet = read_fleet(configuration.at("telemetry"), result); !fleet)
    return tl::make_unexpected(std::move(fleet.error()));
  read_delivery(configuration, result);
  if (const auto objection = mission_client::objection_to(result.client))
    return tl::make_unexpected(*objection);
  result.control_path = control_path(configuration);
  result.log = log_from(configuration.at("log"));
  result.restarts = restarts_from(configuration.at("restarts"));
  return result;
}

} // namespace godwit::daemon
