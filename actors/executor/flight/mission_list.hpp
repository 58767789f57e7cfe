// Which missions the executor knows, for people: see messages/executor/known_missions.hpp. Nothing is decided by it.
// Thread: pure.
#pragma once

#include <string>

#include "actors/executor/flight/flight_context.hpp"
#include "messages/executor/known_missions.hpp"

namespace godwit::executor {

// What those know who hear of missions.
struct mission_news {
  std::string service_refusal; // why the mission of the service is not there; empty: it was not refused
  std::string upload_refusal;  // why the last upload of a station was not taken; empty: it was
  bool is_deleted = false;     // the mission here is gone from the service
};

[[nodiscard]] known_missions list_missions(const flight_context& flight, const mission_news& news);

// MISSION, which the flight can not take; WHY is a sentence for people.
[[nodiscard]] known_mission refused_mission(const flight_context& flight, const std::string& mission_id,
                                            std::int32_t revision, std::string why);

} // namespace godwit::executor
