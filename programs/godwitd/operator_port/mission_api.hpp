// Missions from a browser: POST /api/v1/missions and /api/v1/missions/check, with the text of the file as the body
// (application/octet-stream) and ?format=json, plan, waypoints or geojson; &partial=yes takes what can be taken.
//
//   check: {"mission": ..., "losses": [{"item", "what", "why", "instead", "line"}]}, or 422 with all that is wrong
//   else: the same, and then it goes to mission_desk, which says whether it is taken
//
// It may hold the commands that are ALLOWED as well. The file is read by RUN, beside the thread of the port; where too
// many wait, the answer is 503. Errors: problem documents. Thread: the handlers in that of the port, TELL in that of
// RUN.
#pragma once

#include <functional>
#include <memory>

#include "actors/domain/mission/commands/command_policy.hpp"
#include "programs/godwitd/operator_port/background_worker.hpp"
#include "programs/godwitd/operator_port/mission_desk.hpp"
#include "programs/godwitd/operator_port/route.hpp"

namespace godwit::operator_port {

inline constexpr std::size_t max_mission_file = 1024 * 1024; // bytes: some thousand items

[[nodiscard]] route_list mission_routes(const std::shared_ptr<waiting_answers>& answers,
                                        const std::function<void(mission_upload asked)>& tell,
                                        const run_in_background& run, const mission::allowed_commands& allowed = {});

} // namespace godwit::operator_port
