// What the control port of a missions service answers:
//
//   {"do": "assign", "assignment": {"items": [...], "replace_after_item_id": "w1"}}
//   {"do": "assign FILE"}                     the assignment stands in a file; what is left out of it is filled in
//   {"do": "delete UUID"}                     a mission
//   {"do": "fault lose times 1"}              in the words of fault.hpp, besides those that are on
//   {"do": "faults off"}
//   {"do": "stats"}                           figures.hpp
//   {"do": "quit"}                            ends the program
//
// "mission": UUID says which mission is meant; it is needed when there are several. An answer has "ok", and "error"
// with a sentence where that is false. Thread: that of the service.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "programs/godwit-sim/missions/running_service.hpp"

namespace godwit::sim::missions {

[[nodiscard]] nlohmann::json answer_control(running_service& service, const nlohmann::json& request);

} // namespace godwit::sim::missions
