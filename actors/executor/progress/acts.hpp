// What becomes of the acts of a mission, and the pictures on its lines.
//
// That a vehicle goes on from a release says nothing about the load. What the vehicle or its camera reports of an act
// is kept until its item is resolved, and then part of its report:
//
//   DO_GRIPPER                 ArduPilot: "Gripper load released", "Gripper load grabbed". "Gripper Released" comes
//                              with the command, also where there is no gripper, and confirms nothing
//   NAV_PAYLOAD_PLACE          ArduPilot: "Gripper load released" while it is placed; failed: "PayloadPlace: Reached
//                              maximum descent", after which REACHED comes and the load is still on board
//   IMAGE_START_CAPTURE of 1   a picture
//
// Pictures are counted for each item that moves the vehicle, by their numbers: one that nobody heard counts where a
// later one was. A trigger by distance takes its first one where it is switched on and, asked for that, the last one
// where it is switched off: vehicle and camera report this in any order, and both count on the line. Items are resolved
// in the order of the mission, so an act that may be reported holds up those after it, or the end of the plan, for
// outcome_late_ns; so does the last picture of a line on which others were reported. An act after a condition is
// awaited until that may have come true, at most until the next place: what has not run by then is dropped. Thread: one
// at a time. Source: seen of ArduCopter 4.7.0-dev and PX4 1.18.0-beta1; param3 of DO_SET_CAM_TRIGG_DIST in both.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "actors/executor/progress/decision_context.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"

namespace godwit::executor::progress {

[[nodiscard]] act_kind act_of(const io::mavlink::mission_item_int& item, bool is_ardupilot);

// Nothing: it is about no act.
[[nodiscard]] std::optional<act_told> act_in(std::string_view text);

void take(decision_context& t, const act_told& what);
void take(decision_context& t, const picture_told& what);

// A picture of a moment ago is that of an act or of a line to which the vehicle has come now.
void adopt_early_picture(decision_context& t);

// The vehicle has gone on from an act of which a report may still come.
[[nodiscard]] bool awaits_outcome(const followed_plan& plan);
// So is the item at POSITION.
[[nodiscard]] bool awaits_outcome(const followed_plan& plan, std::uint32_t position);

// So long after the vehicle has gone on the acts that are awaited may be reported.
[[nodiscard]] std::int64_t outcomes_late_ns(const followed_plan& plan);

// The last picture of the line that ends where the vehicle is may still come.
[[nodiscard]] bool awaits_last_picture(const followed_plan& plan);

// The item to which the pictures counted so far belong is resolved: those after it count for the next.
void begin_next_pictures(generation_state& g);

// What is known of the item at POSITION, which is resolved as KIND now; it is forgotten by that.
[[nodiscard]] item_findings take_findings(decision_context& t, std::uint32_t position, mission::progress_kind kind);

} // namespace godwit::executor::progress
