// What ground stations see of a mission, in the numbers of the plan that ground_port shows them.
//
//   who made the plan        what is shown                         how items are counted
//   a station                its own upload, untouched             as in its upload
//   the service, a file      what was uploaded to the vehicle      from 0
//
// A station's plan stays what is shown while an operator sends the vehicle elsewhere, and back: the current item is
// then the one with which it would go on, as on a vehicle alone. Where the flight has ended elsewhere, or with what an
// operator has inserted, the plan is shown as the vehicle has it, too. An ArduPilot keeps
// its home as item 0, and stations that take us for one (WITH_HOME) expect it there, and leave it out of what they
// show. Pure; thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "actors/executor/state.hpp"
#include "actors/executor/view.hpp"
#include "messages/ground_port/mission.hpp"

namespace godwit::executor {

// The mission that a station has uploaded, or that will be as soon as it can be taken, as long as nobody has changed
// it. Null: it is another one.
[[nodiscard]] const mission::document* uploaded_mission(const state& s);

// What is flown is the upload of a station, as it came.
[[nodiscard]] inline bool flies_upload(const state& s) { return uploaded_mission(s) != nullptr; }

// The upload of a station is shown as it came. Else items_on_vehicle are.
[[nodiscard]] bool shows_upload(const state& s);

// Of the plan that the vehicle has, from 0 on. Empty: there is none.
[[nodiscard]] std::vector<io::mavlink::mission_item_int> items_on_vehicle(const state& s, bool with_home);

// The item of the vehicle's plan at which what is shown as item INDEX begins, or what follows it where the vehicle has
// none for it. Nothing: it is beyond the plan, or the vehicle has it no more: it flies the rest after a go to.
[[nodiscard]] std::optional<std::uint16_t> vehicle_sequence_of(const state& s, std::uint16_t index, bool with_home);

// PLAN_ID is that of what is shown.
[[nodiscard]] ground_port::mission_progress progress_shown(const state& s, const vehicle_view& view,
                                                           std::uint32_t plan_id, bool with_home);

// The item that REPORT says is reached. Nothing: it says something else, or belongs to an earlier plan.
[[nodiscard]] std::optional<ground_port::item_reached>
reached_shown(const state& s, const mission::progress_report& report, bool with_home);

} // namespace godwit::executor
