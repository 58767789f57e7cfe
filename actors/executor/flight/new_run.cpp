#include "actors/executor/flight/new_run.hpp"

#include <utility>

#include "actors/domain/mission/convert/conversion.hpp"
#include "actors/executor/station_part.hpp"
#include "actors/executor/station_plan.hpp"

namespace godwit::executor {
std::string why_no_new_run(const flight_context& flight) {
  const auto& s = flight.s;
  if (!is_at_rest(s.status.now) || !s.mission || s.arrived)
    return "the flight is not ready: " + flight.sentence();
  if (flight.has_person())
    return "the vehicle has to be handed back first: " + s.status.reason;
  if (flight.has_service())
    return "mission " + s.mission->mission_id +
           " is over: the missions service has to give it a new revision, or another one";
  if (uploaded_mission(s) == nullptr && !flight.as_it_came)
    return "mission " + s.mission->mission_id + " is over, and godwit was restarted since it came: hand it over again";
  return {};
}

bool begin_new_run(flight_context& flight, effects& out, instant now) {
  if (!std::exchange(flight.wanted.new_run, false) || !why_no_new_run(flight).empty())
    return false;
  std::string id;
  if (uploaded_mission(flight.s) != nullptr) {
    const auto next = as_new_mission(*part_of_plan(flight.s, whole_plan(flight.s), !flight.drives()), now.wall_ns);
    id = next.mission.mission_id;
    out.emplace_back(note{next});
  } else {
    auto next = *flight.as_it_came;
    next.mission_id = mission::uuid_of_text("a run of " + next.mission_id + " at " + std::to_string(now.wall_ns));
    id = next.mission_id;
    out.emplace_back(note{mission_arrived{std::move(next), true}});
  }
  out.emplace_back(announce{"mission " + flight.s.mission->mission_id + " is prepared again from its first item, as " +
                                id + "; start it when it is ready",
                            false});
  return true;
}

} // namespace godwit::executor
