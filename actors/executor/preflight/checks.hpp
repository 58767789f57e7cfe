// The preflight checks, in the order in which people should look at what they say. Each is a function of what
// is known, and pure; all are skipped while what they look at is not known.
//
//   check             passes                                    degraded             fails                skipped
//   vehicle_link      heartbeats come                                                else
//   open_line         has a key, or stays in the vehicle        else                                      not heard
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
//   traffic           whatever is heard; says what is close                                               none is heard
//
// Thread: pure.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"
#include "io/mavlink/messages/heartbeat.hpp"

namespace godwit::executor::preflight {

// -- vehicle checks ----------------------------------------------------------------------------------------------

// Fails unless the vehicle's heartbeats come, and it is clear which of those on the line it is.
[[nodiscard]] result check_vehicle_link(const facts& seen, const settings& set);

// Degraded while the vehicle is spoken to over a network without a key: whoever is there can speak under its name, and
// nothing but a key ends that. What an operator has acknowledged of a vehicle counts for its next flights, too
// (bit.hpp). Skipped while the vehicle is not heard.
[[nodiscard]] result check_open_line(const facts& seen, const settings& set);

// It is what this check says, and so is acknowledged once for its vehicle.
[[nodiscard]] bool is_about_open_line(std::string_view sentence);

// Fails unless it is known what the vehicle is and whose autopilot it has: modes, failsafes and plans depend on both. A
// generic autopilot is known: it is taken by the MAVLink text. Skipped while the vehicle is not heard.
[[nodiscard]] result check_vehicle_kind(const facts& seen, const settings& set);

// Fails without a position of now from a fix in three dimensions; degraded with few satellites. A receiver that is set
// up as a base station tells where it was put and not where it is. Skipped while the vehicle is not heard.
[[nodiscard]] result check_position(const facts& seen, const settings& set);

// Fails while the vehicle does not know its home: a failsafe that returns would have nowhere to go. Skipped while the
// vehicle is not heard.
[[nodiscard]] result check_home(const facts& seen, const settings& set);

// Fails while the vehicle is in the air or drives, and godwit has not started it: whoever flies it has a plan, and it
// is not replaced. Skipped while the vehicle is not heard.
[[nodiscard]] result check_on_ground(const facts& seen, const settings& set);

// Fails unless the battery is above the level at which the failsafe returns, by a margin. Degraded when the autopilot
// does not know its level: the failsafe then does not either. Skipped while the vehicle is not heard.
[[nodiscard]] result check_battery(const facts& seen, const settings& set);

// Fails unless the autopilot's own checks before arming pass. Degraded when it does not say whether they do. Skipped
// while the vehicle is not heard. Source: MAV_SYS_STATUS_PREARM_CHECK of MAVLink's common.xml.
[[nodiscard]] result check_autopilot_checks(const facts& seen, const settings& set);

inline constexpr std::uint32_t prearm_check_bit = 0x1000'0000; // MAV_SYS_STATUS_PREARM_CHECK

// What SYS_STATUS says about them. ArduPilot has the bit in `present` and, when they pass, in `health`. PX4 1.17 has it
// in `health` alone, so that for PX4 no bit at all means that they fail; from anybody else it means nothing.
[[nodiscard]] own_checks own_checks_of(const io::mavlink::sys_status& told, io::mavlink::mav_autopilot autopilot);

// Fails while the vehicle's estimator does not know where it is: it can not be armed then for a flight by a plan, or is
// refused its mission mode, also where the autopilot's own checks pass already (ArduPilot: some 16 s before). Skipped
// for a vehicle that does not tell, and while it is not heard.
//
// Source: EKF_STATUS_REPORT (193) of ardupilotmega.xml, ESTIMATOR_STATUS (230) of common.xml; ArduPilot's
// "Need Position Estimate".
[[nodiscard]] result check_vehicle_ready(const facts& seen, const settings& set);

// FLAGS of either message.
[[nodiscard]] estimate estimate_of(std::uint16_t flags);

// Whether this autopilot has a message for it at all, so that it is waited for.
[[nodiscard]] bool tells_estimate(io::mavlink::mav_autopilot autopilot);

// -- plan checks -------------------------------------------------------------------------------------------------

// Fails unless a mission is loaded, and can be said to this vehicle.
[[nodiscard]] result check_mission(const facts& seen, const settings& set);

// Fails when a place of the mission lies farther from home, or higher above it, than the vehicle may be sent. Skipped
// without a mission, or while the vehicle is not heard.
[[nodiscard]] result check_places(const facts& seen, const settings& set);

// Compares the home for which a file was planned with the vehicle's. Nothing flies to the planned one; when it is far
// off, the mission may be one for another place.
[[nodiscard]] result check_planned_home(const facts& seen, const settings& set);

// Ground stations take the place where the map stood, or where the vehicle stood when the plan was drawn: some ten
// metres from where it takes off are usual.
inline constexpr double far_from_planned_home_m = 100;

// Fails when the way of the mission, legs included, leaves the inclusion fences or comes into an exclusion fence.
// Skipped where there are no fences, or no plan whose way could be looked at; the check of the mission fails then.
//
[[nodiscard]] result check_fences(const facts& seen, const settings& set);

// Fails when the return point lies outside of the inclusion fences or in an exclusion fence. Skipped without a mission
// or fences.
[[nodiscard]] result check_return_point(const facts& seen, const settings& set);

// Says when a failsafe's return, which the autopilot flies straight home, would cross an exclusion fence from
// somewhere on the way of the mission; names the items on the way to which that is so. Degraded where that is asked
// for, else it passes. Skipped where there are no fences, or no plan whose way could be looked at; the check of the
// mission fails then.
[[nodiscard]] result check_straight_return(const facts& seen, const settings& set);

inline constexpr std::size_t max_named_items = 8; // as many as anyone reads

// Of at least one.
[[nodiscard]] std::string crossing_sentence(const std::vector<plan::return_crossing>& all,
                                            const mission::document& mission);

// Degraded when the battery does not last for the plan and the straight way home after it, above the level at which
// the failsafe returns; where flights begin by themselves, and nobody could acknowledge it, above the critical level.
// By the drain of the last flight, or the one that was set. Skipped where neither is known,
// without a plan, and while the vehicle is not heard.
[[nodiscard]] result check_energy(const facts& seen, const settings& set);

// -- onboard checks ----------------------------------------------------------------------------------------------

// Fails until the objects of the map are pulled. A copy from before, because the pull failed, is degraded. Skipped for
// a mission that did not come from the service.
[[nodiscard]] result check_map_objects(const facts& seen, const settings& set);

// Fails when the journal can not be written, or did not pass its integrity check: a crash in flight could not be
// recovered from.
[[nodiscard]] result check_journal(const facts& seen, const settings& set);

// Fails when the disk of the journal is about to be full; degraded when it is filling, or its free space is not known.
//
[[nodiscard]] result check_free_space(const facts& seen, const settings& set);

// Fails while the wall clock shows a date before the configured one: it was never set, and reports, certificates and
// signed links go by it.
[[nodiscard]] result check_wall_clock(const facts& seen, const settings& set);

// Fails when an operator has to be there and is not. Skipped where none has to.
[[nodiscard]] result check_operator_session(const facts& seen, const settings& set);

// Fails unless every actor runs: one that was given up does not come back by itself.
[[nodiscard]] result check_actors(const facts& seen, const settings& set);

// Degraded when the camera is on and not ready: the flight is as safe without pictures, and may be of no use. Skipped
// when it is off.
[[nodiscard]] result check_camera(const facts& seen, const settings& set);

// Says which other aircraft are close; whether one flies then, a person decides, and nobody is asked. Skipped while
// none is heard, which does not say that none is there.
[[nodiscard]] result check_traffic(const facts& seen, const settings& set);

struct check {
  std::string_view name;
  result (*look)(const facts& seen, const settings& set);
};

inline constexpr std::array checks{check{"vehicle_link", check_vehicle_link},
                                   check{"open_line", check_open_line},
                                   check{"vehicle_kind", check_vehicle_kind},
                                   check{"position", check_position},
                                   check{"home", check_home},
                                   check{"on_ground", check_on_ground},
                                   check{"battery", check_battery},
                                   check{"autopilot_checks", check_autopilot_checks},
                                   check{"vehicle_ready", check_vehicle_ready},
                                   check{"mission", check_mission},
                                   check{"places", check_places},
                                   check{"planned_home", check_planned_home},
                                   check{"fences", check_fences},
                                   check{"return_point", check_return_point},
                                   check{"energy", check_energy},
                                   check{"straight_return", check_straight_return},
                                   check{"map_objects", check_map_objects},
                                   check{"journal", check_journal},
                                   check{"free_space", check_free_space},
                                   check{"wall_clock", check_wall_clock},
                                   check{"operator_session", check_operator_session},
                                   check{"actors", check_actors},
                                   check{"camera", check_camera},
                                   check{"traffic", check_traffic}};

} // namespace godwit::executor::preflight
