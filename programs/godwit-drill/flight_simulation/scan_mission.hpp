// A mission with a survey, and what is seen in it: for flights in which points of interest are looked for. Thread: one.
#pragma once

#include <string>

#include "messages/mapobjects_store/observation.hpp"
#include "messages/mission/document.hpp"
#include "programs/godwit-drill/flight_simulation/flight_simulation.hpp"

namespace godwit::drill {

// Takes off, flies a waypoint, four lines of 300 m, and returns; a rover only drives, and ends at a waypoint.
[[nodiscard]] mission::document scan_mission(sim::personality who);

// A vehicle so far behind the southern edge of the survey, seen now.
[[nodiscard]] mapobjects_store::sighting seen_in_survey(const flight_simulation& flight, std::string id, double north_m,
                                                        double confidence);

// The service has heard that it was begun, and of nothing after it.
[[nodiscard]] bool is_in_survey(flight_simulation& flight);

} // namespace godwit::drill
