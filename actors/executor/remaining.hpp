// What of a mission is still to be flown, and what becomes of it when the service assigns other items.
//
// Items are recognised by their ids: two revisions of a mission have in common what has the same id. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "actors/domain/flight_mode/flight_modes.hpp"
#include "actors/executor/plan/change_ids.hpp"
#include "actors/executor/state.hpp"
#include "messages/flight/plan_end.hpp"
#include "messages/mission/change.hpp"
#include "messages/mission/document.hpp"

namespace godwit::executor {

// The items that are done or skipped end with this one: its id. None: nothing is done.
[[nodiscard]] std::optional<std::string> last_done(const state& s);

// The first item of MISSION that is not done: the one after last_done, or the first one. Its size: all are done.
[[nodiscard]] std::size_t first_remaining(const mission::document& mission,
                                          const std::optional<std::string>& last_done);

// The same, but back to the first item that FLOWN, the mission of the plan on the vehicle, does not have: it came late.
[[nodiscard]] std::size_t first_to_fly(const mission::document& mission, const mission::document& flown,
                                       const std::optional<std::string>& last_done);

// So many lines of the item at INDEX are flown, if it is a survey that the plan on the vehicle has, too, and lays the
// same way: after the same items; or that it was sent away from. Else 0. The line that was begun is not flown.
[[nodiscard]] std::uint32_t lines_flown(const state& s, const mission::document& mission, std::size_t index);

// The line of MISSION, from the item at INDEX on, on which pictures were taken and that was left before its end.
// Nothing: there is none, or it is laid in another way now.
[[nodiscard]] std::optional<progress::begun_line> line_begun(const state& s, const mission::document& mission,
                                                             std::size_t index);

// The survey in whose middle the plan on the vehicle is, or that an earlier plan was sent away from.
[[nodiscard]] std::optional<left_survey> survey_left(const state& s);

// What ends the pictures that a camera takes by the plan on the vehicle, where it is now. Nothing: it takes none.
[[nodiscard]] std::optional<io::mavlink::mission_item_int> camera_to_stop(const state& s);

// The vehicle item with which the plan on the vehicle ends: the last one that moves it, without what comes after a
// landing and is kept for a failure. Null: there is no plan.
[[nodiscard]] const io::mavlink::mission_item_int* last_flown_item(const state& s);

// How the plan on the vehicle ends.
[[nodiscard]] flight::plan_end end_of_plan(const flight::mode_owner& whose, const state& s);

struct reassigned {
  mission::document mission;
  std::size_t first_item = 0; // to go on with
};

// ASSIGNMENT applied to MISSION, of which all up to LAST_DONE is flown. What was flown stays in the mission, as far as
// it is not replaced. Errors: a sentence that the service gets as the reason of the refusal.
[[nodiscard]] tl::expected<reassigned, std::string> reassign(const mission::document& mission,
                                                             const mission::assignment& assignment,
                                                             const std::optional<std::string>& last_done);

} // namespace godwit::executor
