// Which exact modes follow from an order, from the end of a plan and from each other.
//
// Two modes of one kind are two modes: whoever ordered BRAKE and sees LOITER sees a person. Where a vehicle has no row
// here, its plan and its modes lead nowhere by themselves.
//
//   vehicle            last item              the plan itself changes into
//   Copter, Rover      any                    nothing: the vehicle stays in AUTO
//   Plane              return                 RTL as the item begins (a QuadPlane: QRTL, QLAND)
//   Plane              landing                nothing
//   Plane              any other              the same when the mission is complete
//   PX4                return                 AUTO.RTL as the item begins
//   PX4                any other              AUTO.LOITER when the mission is complete; after a landing some of them
//                                             (a VTOL, for 0.2 s until its disarm), and nobody has asked for it
//   by MAVLink's text  landing, return        nothing
//   by MAVLink's text  any other              its first holding mode when the mission is complete
//
// Thread: pure. Source: ArduPilot 4.7 (mode_auto.cpp, commands_logic.cpp, mode_rtl.cpp), PX4 1.18 (Commander.cpp,
// mission_block.cpp).
#pragma once

#include <cstdint>
#include <vector>

#include "actors/domain/flight_mode/flight_modes.hpp"
#include "messages/flight/plan_end.hpp"

namespace godwit::flight {

// The modes that obey an order of this kind, in the order in which they may come. Empty: the vehicle has none.
[[nodiscard]] std::vector<std::uint32_t> modes_obeying(const mode_owner& whose, mode_kind kind);

// The modes in which a vehicle that was told MISSION_START may be seen.
[[nodiscard]] std::vector<std::uint32_t> modes_of_start(const mode_owner& whose);

// In which a vehicle stands on the ground and begins nothing when somebody arms it.
[[nodiscard]] std::optional<std::uint32_t> standing_mode(const mode_owner& whose);

// MAV_CMD of a last item after which what flies is on the ground: a landing or a return.
[[nodiscard]] bool leads_down(std::uint16_t last_command);

// LAST_COMMAND: MAV_CMD of the last item that moves the vehicle, at LAST_SEQUENCE.
[[nodiscard]] plan_end plan_end_of(const mode_owner& whose, std::uint16_t last_command, std::uint16_t last_sequence);

// A disarm may lead there by itself: a PX4 goes back to its mission mode, or to a hold where that is finished.
[[nodiscard]] bool may_follow_disarm(const mode_owner& whose, std::uint32_t custom_mode);

// An ArduPlane with RTL_AUTOLAND 2 goes from its return into AUTO at the landing of its plan, and says so
// (ModeRTL::navigate(), mode_rtl.cpp); a person who puts AUTO back does not make it say anything.
[[nodiscard]] bool may_land_by_plan(const mode_owner& whose, std::uint32_t before, std::uint32_t after);

// The autopilot goes from one to the other without anybody's doing. WAS_ORDERED: by us, into the one before. By the
// text alone a return that was ordered may end in a hold; in a return that a person has ordered a hold is a person's
// too.
[[nodiscard]] bool follows_by_itself(const mode_owner& whose, std::uint32_t before, std::uint32_t after,
                                     bool was_ordered);

} // namespace godwit::flight
