// What godwitd is to do, read from its configuration.
//
// Errors: a sentence that names the option, its variable and its place in the file. Thread: pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

#include "actors/domain/mission/commands/command_policy.hpp"
#include "actors/executor/settings.hpp"
#include "actors/failsafe/settings.hpp"
#include "actors/fleet_link/settings.hpp"
#include "actors/mapobjects_store/map_writer.hpp"
#include "actors/mission_client/settings.hpp"
#include "actors/movement_detector/settings.hpp"
#include "actors/operator_bridge/settings.hpp"
#include "actors/scan_controller/settings.hpp"
#include "actors/vehicle_link/settings.hpp"
#include "io/http/settings.hpp"
#include "io/link/uri.hpp"
#include "messages/operator/principal.hpp"
#include "programs/godwitd/link_log/link_log_options.hpp"
#include "programs/godwitd/log/log_settings.hpp"
#include "programs/godwitd/operator_port/settings.hpp"
#include "programs/godwitd/service/crash_loop_guard.hpp"
#include "runtime/process.hpp"

namespace godwit::daemon {

struct daemon_settings {
  runtime::process_options process;
  std::optional<link_log_options> link_log;  // none: the links are not recorded
  std::optional<io::http::settings> service; // none: the mission comes from mission_file
  mission_client::settings client;           // how it is asked
  std::string mission_id;                    // with a service; else as the file says; empty: the next ones
  std::string vehicle_id;                    // whose they are, as the service calls it
  std::string mission_file;                  // without
  bool allow_partial = false;
  mission::allowed_commands allowed_commands; // that no mission may hold otherwise
  io::link::uri vehicle;
  std::uint8_t vehicle_system = 0;
  bool vehicle_line_is_secure = false; // nobody else hears it: the key may go over it, and unsigned frames are taken
  vehicle_link::settings link;         // without the system
  std::string signing_key_file;        // empty: nothing is signed
  bool flies = true;                   // false: a run on the ground
  executor::settings flight;
  failsafe::settings failsafe;
  std::optional<io::link::uri> ground; // none: no ground station is spoken to
  bool speaks_as_autopilot = true;     // there: for stations that bring missions to nobody else
  std::string ground_key_file;         // empty: nothing is signed there
  godwit::operators::role unsigned_stations =
      godwit::operators::role::operator_; // what they are where nothing is signed
  bool ground_passes = true;              // reading and what people do goes on to the vehicle
  std::vector<std::string> ground_also_passes;
  int ground_max_items = 1'000; // of one plan of a station
  mapobjects_store::map_writer_options map;
  scan_controller::settings scan;
  std::optional<movement_detector::settings> camera; // none: nobody looks
  std::string eyes_program;                          // with a camera; empty: godwit-eyes beside godwitd
  std::string control_path;
  std::optional<operator_port::settings> operators; // none: there is no port for them
  std::string accounts_file;                        // of operators; need not be there
  std::string pictures_folder;                      // of points of interest; need not be there
  operator_bridge::settings sessions;               // theirs
  std::optional<fleet_link::settings> fleet;        // none: no broker is told anything
  std::string sightings_file;                       // "-": standard input; empty: none
  bool once = false;
  bool allow_crash = false; // `godwitd ctl crash` is obeyed: for drills
  log_settings log;
  start_limits restarts;
};

// CONFIGURATION is complete and valid by its schema.
[[nodiscard]] tl::expected<daemon_settings, std::string> settings_from(const nlohmann::json& configuration);

[[nodiscard]] std::string journal_path(const nlohmann::json& configuration);
[[nodiscard]] std::string map_path(const nlohmann::json& configuration);
[[nodiscard]] std::string control_path(const nlohmann::json& configuration);
[[nodiscard]] std::string accounts_path(const nlohmann::json& configuration);

} // namespace godwit::daemon
