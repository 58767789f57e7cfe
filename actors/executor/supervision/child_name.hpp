// Which actors a process of godwitd has: each is named here, and has its row in table.cpp. Thread: constants.
#pragma once

#include <string>

#include "io/fields/field_table.hpp"

namespace godwit::executor::supervision {

enum class child_name {
  vehicle_link,
  failsafe,
  executor,
  mission_client,
  mapobjects_store,
  ground_port,
  operator_bridge,
  landing_watch,
  sightings,
  scan_controller,
  movement_detector,
  health,
  telemetry_stream,
  fleet_link,
  view_handler,
  mission_handler,
  operator_handler,
  control_handler,
  ground_run // in the place of the executor
};

GODWIT_ENUM_NAMES(child_name, vehicle_link, failsafe, executor, mission_client, mapobjects_store, ground_port,
                  operator_bridge, landing_watch, sightings, scan_controller, movement_detector, health,
                  telemetry_stream, fleet_link, view_handler, mission_handler, operator_handler, control_handler,
                  ground_run);

[[nodiscard]] inline std::string name(child_name which) { return std::string(io::name_of(which)); }

} // namespace godwit::executor::supervision
