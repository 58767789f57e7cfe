// What can be set about the executor. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>

#include "actors/executor/preflight/settings.hpp"
#include "io/fields/field_table.hpp"

namespace godwit::executor {

enum class start_policy {
  on_command, // of an operator, or MISSION_START of a ground station
  automatic   // as soon as all is ready
};

constexpr auto enum_names(start_policy) {
  return io::names<start_policy>({{start_policy::on_command, "on_command"}, {start_policy::automatic, "automatic"}});
}

struct settings {
  std::string mission_id; // that the service is asked for; empty: missions come from elsewhere
  bool has_service = true;
  start_policy start = start_policy::on_command;
  bool arm_on_start = false; // else a person arms
  double own_loiter_radius_m = 80;
  double return_altitude_m = 0;
  preflight::settings checks;
};

} // namespace godwit::executor
