// The preflight checks, in the order in which people should look at what they say. Each has a file of its own in
// checks/.
//
//   check             passes                                    degraded             fails                skipped
//   vehicle_link      heartbeats come                                                else
//   vehicle_kind      class and autopilot are known                                  else                 not heard
//   position          3-D fix, position of now                  few satellites       else                 not heard
//   home              known                                                          else                 not heard
//   on_ground         stands, or flies for us                                        else                 not heard
//   battery           above return level and margin             level not known      else, no news yet    not heard
//   autopilot_checks  pass                                      does not say         fail, no news yet    not heard
//   vehicle_ready     estimator knows its place                 no: a Plane          no, no news yet      not told
//   mission           loaded, and planned for this vehicle                           else
//   places            within the limits around home                                  else                 no mission
//   planned_home      near the vehicle's home                   far from it          not looked at yet    none
//   fences            way inside inclusions, outside exclusions                      else                 no fences
//   return_point      the same                                                       else                 no fences
//   straight_return   from no leg into an exclusion, or told    else, where asked    not looked at yet    no fences
//   energy            lasts for plan and way home               does not                                  drain unknown
//   map_objects       pulled                                    copy from before     else                 no service
//   journal           written and sound                                              else
//   free_space        enough                                    low, not known       next to nothing
//   wall_clock        later than the configured date                                 else
//   operator_session  alive                                                          else                 not required
//   actors            all run                                                        else
//   camera            ready                                     not ready            no news yet          off
//
// Thread: constants.
#pragma once

#include <array>
#include <string_view>

#include "actors/executor/preflight/checks/actors.hpp"
#include "actors/executor/preflight/checks/autopilot_checks.hpp"
#include "actors/executor/preflight/checks/battery.hpp"
#include "actors/executor/preflight/checks/camera.hpp"
#include "actors/executor/preflight/checks/energy.hpp"
#include "actors/executor/preflight/checks/fences.hpp"
#include "actors/executor/preflight/checks/free_space.hpp"
#include "actors/executor/preflight/checks/home.hpp"
#include "actors/executor/preflight/checks/journal.hpp"
#include "actors/executor/preflight/checks/map_objects.hpp"
#include "actors/executor/preflight/checks/mission.hpp"
#include "actors/executor/preflight/checks/on_ground.hpp"
#include "actors/executor/preflight/checks/operator_session.hpp"
#include "actors/executor/preflight/checks/places.hpp"
#include "actors/executor/preflight/checks/planned_home.hpp"
#include "actors/executor/preflight/checks/position.hpp"
#include "actors/executor/preflight/checks/return_point.hpp"
#include "actors/executor/preflight/checks/straight_return.hpp"
#include "actors/executor/preflight/checks/vehicle_kind.hpp"
#include "actors/executor/preflight/checks/vehicle_link.hpp"
#include "actors/executor/preflight/checks/vehicle_ready.hpp"
#include "actors/executor/preflight/checks/wall_clock.hpp"

namespace godwit::executor::preflight {

struct check {
  std::string_view name;
  result (*look)(const facts& seen, const settings& set);
};

inline constexpr std::array checks{check{"vehicle_link", look_at_vehicle_link},
                                   check{"vehicle_kind", look_at_vehicle_kind},
                                   check{"position", look_at_position},
                                   check{"home", look_at_home},
                                   check{"on_ground", look_at_on_ground},
                                   check{"battery", look_at_battery},
                                   check{"autopilot_checks", look_at_autopilot_checks},
                                   check{"vehicle_ready", look_at_vehicle_ready},
                                   check{"mission", look_at_mission},
                                   check{"places", look_at_places},
                                   check{"planned_home", look_at_planned_home},
                                   check{"fences", look_at_fences},
                                   check{"return_point", look_at_return_point},
                                   check{"energy", look_at_energy},
                                   check{"straight_return", look_at_straight_return},
                                   check{"map_objects", look_at_map_objects},
                                   check{"journal", look_at_journal},
                                   check{"free_space", look_at_free_space},
                                   check{"wall_clock", look_at_wall_clock},
                                   check{"operator_session", look_at_operator_session},
                                   check{"actors", look_at_actors},
                                   check{"camera", look_at_camera}};

} // namespace godwit::executor::preflight
