// The configuration that counts: command line over environment over file over defaults.
//
// Errors: sentences that name the option, the variable or the place in the file. A variable that begins with GODWIT_
// and that nobody knows is an error too: whoever mistypes GODWIT_TOKEN_FILE would else look for the mistake at the
// service. Thread: pure, but for reading the file.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

namespace godwit::daemon {

// By the name of the option or variable. A flag that was given is "true".
using given_texts = std::map<std::string, std::string, std::less<>>;

// Complete, and valid by config/godwit.schema.json.
[[nodiscard]] tl::expected<nlohmann::json, std::string> effective_configuration(const given_texts& command_line,
                                                                                const given_texts& environment);

// The variables of this process that begin with GODWIT_.
[[nodiscard]] given_texts godwit_variables();

// What can be set on the command line, as one table: each row is an option, a variable of the environment and a place
// in the configuration file.
//
//   --token-file FILE  =  GODWIT_TOKEN_FILE=FILE  =  {"service": {"token_file": "FILE"}}
//
// The command line stands above the environment, that above the file, and that above the defaults. Thread: pure.
enum class option_kind { text, flag }; // a flag in the environment is true, 1, false or 0

struct option_row {
  std::string_view name;  // without the dashes in front
  std::string_view place; // RFC 6901; empty: only where the file is
  option_kind kind = option_kind::text;
  std::string_view type_name;
  std::string_view help;
};

inline constexpr std::string_view config_option = "config";

inline constexpr std::array option_rows{
    option_row{"service", "/service/url", option_kind::text, "URL",
               "The missions service, such as https://missions.example.org"},
    option_row{"mission-id", "/mission/id", option_kind::text, "UUID", "The mission, as the service calls it"},
    option_row{"vehicle-id", "/service/vehicle", option_kind::text, "NAME",
               "Instead: the vehicle, whose next mission the service is asked for, one after the other"},
    option_row{"token-file", "/service/token_file", option_kind::text, "FILE",
               "The vehicle's token for the service; mode 0600"},
    option_row{"ca-file", "/service/ca_file", option_kind::text, "FILE",
               "Believes these issuers of certificates (PEM) and no others"},
    option_row{"certificate-file", "/service/certificate_file", option_kind::text, "FILE",
               "Our own certificate (PEM), with --key-file"},
    option_row{"key-file", "/service/key_file", option_kind::text, "FILE",
               "The key of our own certificate (PEM); mode 0600"},
    option_row{"proxy", "/service/proxy", option_kind::text, "URL", "Reaches the service through this proxy"},
    option_row{"mission", "/mission/file", option_kind::text, "FILE",
               "A mission from a file instead: .json, .plan, .waypoints or .txt (QGC WPL 110), .geojson, .kml"},
    option_row{"allow-partial", "/mission/allow_partial", option_kind::flag, "",
               "Takes a file of which not everything can be carried over"},
    option_row{"vehicle", "/vehicle/uri", option_kind::text, "URI",
               "The link to the autopilot, such as udpin://0.0.0.0:14550 or serial:///dev/ttyAMA0:921600"},
    option_row{"signing-key", "/vehicle/key_file", option_kind::text, "FILE",
               "Signs on that link with this key, and believes only what is signed with it; mode 0600"},
    option_row{"ground-run", "/flight/ground_run", option_kind::flag, "",
               "Flies nothing: fetches, keeps the map, takes sightings and delivers; --once does so, too"},
    option_row{"start", "/flight/start", option_kind::text, "WHEN",
               "on_command (as it is), or automatic, as soon as a flight is ready"},
    option_row{"arm-on-start", "/flight/arm_on_start", option_kind::flag, "", "Arms the vehicle when a flight starts"},
    option_row{"takeoff-again", "/flight/takeoff_again", option_kind::text, "WHEN",
               "After a landing on the way: on_command (as it is), or automatic"},
    option_row{"allow-crash", "/flight/allow_crash", option_kind::flag, "",
               "Obeys `godwitd ctl crash ACTOR`: for drills only"},
    option_row{"ground", "/ground/uri", option_kind::text, "URI",
               "The line for ground stations, such as udpin://0.0.0.0:14555"},
    option_row{"ground-as-autopilot", "/ground/as_autopilot", option_kind::flag, "",
               "Speaks there as the autopilot: for ground stations that speak with no other component"},
    option_row{"ground-signing-key", "/ground/key_file", option_kind::text, "FILE",
               "Signs on that line with this key, and believes only what is signed with it; mode 0600"},
    option_row{"accounts", "/operator/accounts", option_kind::text, "FILE",
               "The accounts of operators, as `godwitd operator` writes them (beside the journal)"},
    option_row{"camera", "/camera/uri", option_kind::text, "URI",
               "Looks for what moves with this camera: v4l2:///dev/video0, rtsp://..., file:///..., test://ball"},
    option_row{"sightings", "/sightings/file", option_kind::text, "FILE",
               "Takes sightings from this file of JSON lines; - is standard input"},
    option_row{"once", "/sightings/once", option_kind::flag, "",
               "Delivers what was seen when the sightings end, and ends when the service has it"},
    option_row{"journal", "/journal/path", option_kind::text, "FILE", "The durable memory (godwit.db)"},
    option_row{"map", "/map/path", option_kind::text, "FILE", "The map of what was seen (beside the journal)"},
    option_row{"trace", "/trace/directory", option_kind::text, "FOLDER", "The record of every message (trace)"},
    option_row{"control", "/control/path", option_kind::text, "FILE",
               "The socket for `godwitd ctl` (beside the journal)"},
    option_row{"operator-listen", "/operator/listen", option_kind::text, "ADDRESS",
               "The port for operators and programs, such as 127.0.0.1:8088; with TLS 0.0.0.0:8443"},
    option_row{"broker", "/telemetry/broker", option_kind::text, "URI",
               "Telemetry and events go to this broker of MQTT: mqtts://host:8883, with --vehicle-name"},
    option_row{"vehicle-name", "/telemetry/vehicle", option_kind::text, "NAME", "The vehicle's own name at the broker"},
    option_row{"log-file", "/log/file", option_kind::text, "FILE",
               "The log goes there instead of standard output; SIGHUP opens it anew"},
    option_row{"log-format", "/log/format", option_kind::text, "text|json", "How a line of the log looks (text)"},
    option_row{"log-level", "/log/level", option_kind::text, "info|warning|error",
               "What is logged: this, and what is worse (info)"},
    option_row{config_option, "", option_kind::text, "FILE", "Settings (config/godwit.json shows the defaults)"},
};

// Null: there is none of that name.
[[nodiscard]] const option_row* find_option(std::string_view name);

// "GODWIT_TOKEN_FILE"
[[nodiscard]] std::string variable_of(const option_row& row);

// How people may have given it: "--token-file (GODWIT_TOKEN_FILE, service.token_file)".
[[nodiscard]] std::string all_names_of(std::string_view option);

} // namespace godwit::daemon
