// The table of the failsafes: what may trigger, what is done about it by each class of vehicle, and what comes first.
//
//   priority  rule              multirotor  fixed wing                        rover   an operator may override it
//   1         battery_critical  land        return, or the mission's landing  hold    never
//   2         fence             return      return                            hold    until a deadline
//   3         battery_low       return      return                            return  until a deadline
//   4         operator_link     return      return                            return  until a deadline
//
// Where a return would not lead to the mission's home, after a landing on the way, the vehicle holds in its place.
// That the link to the autopilot is down is no rule: nothing could be sent, and the autopilot's own failsafe acts.
// A lower rule never cancels what a higher one does. Thread: constants.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "actors/failsafe/vehicle.hpp"
#include "messages/failsafe/types.hpp"

namespace godwit::failsafe {

inline constexpr std::array rules{rule::battery_critical, rule::fence, rule::battery_low, rule::operator_link};

[[nodiscard]] constexpr std::size_t index_of(rule each) { return static_cast<std::size_t>(each); }
[[nodiscard]] constexpr int priority_of(rule each) { return static_cast<int>(each) + 1; }
[[nodiscard]] constexpr bool is_higher(rule one, rule other) { return priority_of(one) < priority_of(other); }

// A vehicle that falls out of the sky is no operator's choice.
[[nodiscard]] constexpr bool may_be_overridden(rule each) { return each != rule::battery_critical; }

// Nothing for a vehicle of which it is not known what it is.
[[nodiscard]] std::optional<action> action_for(rule each, vehicle_class what, bool mission_has_land_start);

// Whether a vehicle in this mode does already what the action wants. Who lands needs no return.
[[nodiscard]] bool is_done_by(action wanted, mode_kind mode);

// The modes into which a vehicle may go when it is told to do this.
[[nodiscard]] std::array<mode_kind, 2> modes_of(action wanted);

} // namespace godwit::failsafe
