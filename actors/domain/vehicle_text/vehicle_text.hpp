// What an autopilot's STATUSTEXT means to a flight, where it means something.
//
// Texts are for people, and each version may word them anew: what is not known here says nothing. Nothing is ever done
// because of a text alone; it tells who did what was seen, and gives the reason that people are told. Thread: pure.
// Source: ArduPilot 4.7 (Copter events.cpp and ekf_check.cpp, Plane events.cpp, Rover failsafe.cpp, AP_Arming),
// PX4 1.17 (health and arming checks); STATUSTEXT (253) of MAVLink's common.xml.
#pragma once

#include <string_view>

#include "io/mavlink/messages/heartbeat.hpp"

namespace godwit::flight {

// Up to its NUL. Of a text in pieces it is that of this piece. Lives as long as M.
[[nodiscard]] std::string_view text_of(const io::mavlink::statustext& m);

// An ArduPilot's failsafe acts: "EKF Failsafe: changed to LAND Mode", "Radio Failsafe", "GCS Failsafe On: switched to
// RTL". Not: one that is over ("GCS Failsafe Cleared"), or that changes nothing ("Radio Failsafe - Continuing Auto").
[[nodiscard]] bool tells_failsafe(std::string_view text);

// An ArduPilot has left its own fence: "Circle fence breached", "Max Alt and Circle fences breached" (Copter and Plane,
// AC_Fence::print_fence_message; a Rover has no words for it). Whether it changes its mode for that is a parameter, and
// a pilot who hears it may do so as well: only what changes in the same moment is its doing.
[[nodiscard]] bool tells_fence_breach(std::string_view text);

// Another plan is on the vehicle: "Auto mission changed, restarted command" (ArduPilot in AUTO, on all lines), "Flight
// plan received" (to whoever has uploaded it). An upload of ours makes it say so as well.
[[nodiscard]] bool tells_new_plan(std::string_view text);

// An ArduPlane goes on with the landing of its plan: "Landing sequence start", of itself out of a return
// (RTL_AUTOLAND, jump_to_landing_sequence() in AP_Mission.cpp), or because somebody has said DO_LAND_START.
[[nodiscard]] bool tells_landing_of_plan(std::string_view text);

// Why it can not be armed: "PreArm: Compass not calibrated" (ArduPilot), "Preflight Fail: ..." (PX4).
[[nodiscard]] bool tells_why_not_armed(std::string_view text);

} // namespace godwit::flight
