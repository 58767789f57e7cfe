// What can be set about the executor. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>

#include "actors/domain/mission/commands/command_policy.hpp"
#include "actors/domain/mission/place_limits.hpp"
#include "actors/domain/traffic/traffic.hpp"
#include "actors/executor/preflight/settings.hpp"
#include "io/fields/field_table.hpp"

namespace godwit::executor {

enum class start_policy {
  on_command, // of an operator, or MISSION_START of a ground station
  automatic   // as soon as all is ready
};

GODWIT_ENUM_NAMES(start_policy, on_command, automatic);

// What follows when the service refuses to insert a waypoint, again and again.
enum class refusal_policy { go_on, come_home };

GODWIT_ENUM_NAMES(refusal_policy, go_on, come_home);

// What follows when the failsafe can not be kept up in flight. In both cases there are no new plans, and people are
// told.
enum class failsafe_gone_policy {
  come_home, // once, unless a person has the vehicle
  go_on
};

constexpr auto enum_names(failsafe_gone_policy) {
  return io::names<failsafe_gone_policy>(
      {{failsafe_gone_policy::come_home, "return"}, {failsafe_gone_policy::go_on, "continue"}});
}

// What follows when the service has deleted a mission that was begun: it is flown to its end, also after a landing on
// the way, or the vehicle comes home in flight and stays on the ground. In both cases people are told then, and when
// the vehicle is down.
enum class deletion_policy { go_on, come_home };

constexpr auto enum_names(deletion_policy) {
  return io::names<deletion_policy>({{deletion_policy::go_on, "continue"}, {deletion_policy::come_home, "return"}});
}

// In which missions points of interest are shown to people: scan_controller runs only while one of these is flown.
enum class scan_policy { with_survey, all, none };

GODWIT_ENUM_NAMES(scan_policy, with_survey, all, none);

struct settings {
  std::string mission_id; // that the service is asked for, or of the file; empty: the next one of the service, or
                          // ground stations bring missions
  bool has_service = true;
  std::string vehicle_id; // as the service calls the vehicle, whose next mission it is asked for
  start_policy start = start_policy::on_command;
  bool arm_on_start = false; // else a person arms
  // After a landing on the way, and whenever else this mission has flown before.
  start_policy takeoff_again = start_policy::on_command;
  refusal_policy refused_inserts = refusal_policy::go_on;
  bool changes_need_service = false;    // a go-to, insert or cancel waits for its answer
  std::int64_t service_wait_ms = 2'000; // else it is flown when there was none for so long
  deletion_policy deleted_mission = deletion_policy::go_on;
  scan_policy scans = scan_policy::with_survey;
  failsafe_gone_policy failsafe_gone = failsafe_gone_policy::come_home;
  mission::place_limits limits;  // of each mission, and of a place to which an operator sends the vehicle
  double fence_margin_m = 10;    // of the way to where an operator sends the vehicle
  traffic::limits close_traffic; // of which people are told
  double own_loiter_radius_m = 80;
  double return_altitude_m = 0;
  double drain_percent_per_min = 0;           // of the battery, before it was measured in a flight; 0: not known
  mission::allowed_commands allowed_commands; // guarded and unknown ones that a mission may hold
  bool allow_partial = false;   // of a station's plan: take what a mission can say, and tell what it can not
  bool shows_home = false;      // to stations, where the vehicle keeps its home as item 0: they take us for it
  bool brings_last_line = true; // fences and rally points to the vehicle as well: flight/last_line.hpp
  bool marks_landings = false;  // of fixed wings, with DO_LAND_START: see plan/setting.hpp
  preflight::settings checks;

  // One mission after the other, as the service gives them.
  [[nodiscard]] bool asks_next() const { return has_service && mission_id.empty() && !vehicle_id.empty(); }
};

} // namespace godwit::executor
