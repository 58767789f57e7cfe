#include "programs/godwit-sim/missions/assignment_calls.hpp"

#include "actors/domain/mission/write.hpp"
#include "messages/mission/answer.hpp"
#include "programs/godwit-sim/missions/assignment_table.hpp"
#include "programs/godwit-sim/missions/change.hpp"
#include "programs/godwit-sim/missions/delivered_table.hpp"
#include "programs/godwit-sim/missions/once.hpp"

namespace godwit::sim::missions {
namespace {

// The mission as ASSIGNMENT makes it. None: it was made for another one.
std::optional<mission::document> taken_over(service_file& file, const call& at, const mission::assignment& assignment) {
  if (assignment.base_revision != at.mission.revision)
    return std::nullopt;
  auto changed = changed_mission(stored_mission(file, at.to.mission_id), assignment.replace_after_item_id,
                                 assignment.items, behind::replace, "/items");
  if (!changed)
    return std::nullopt;
  changed->revision = assignment.revision;
  return *std::move(changed);
}

answer take_response(service_file& file, const call& at, const mission::assignment_response& body) {
  if (body.last_progress && body.last_progress->mission_id != at.to.mission_id)
    return wrong_place("/last_progress/mission_id", "is " + mission::in_quotes(body.last_progress->mission_id),
                       "the mission that the request is about");
  const auto found = find_assignment(file, at.to.mission_id, at.to.assignment_id);
  if (!found)
    return problem_answer(404, "The mission has no assignment " + at.to.assignment_id + ".");
  if (found->outcome && *found->outcome != body.outcome)
    return problem_answer(409, "This assignment was " + std::string(io::name_of(*found->outcome)) + " before.");
  if (!found->outcome && body.outcome == mission::assignment_outcome::accepted) {
    const auto changed = taken_over(file, at, found->what);
    if (!changed)
      return problem_answer(409, "The mission is at revision " + std::to_string(at.mission.revision) +
                                     ", and the assignment was made for " + std::to_string(found->what.base_revision) +
                                     ".");
    replace_mission(file, *changed);
  }
  set_outcome(file, at.to.assignment_id, body.outcome);
  const bool is_new = put_row(file, at.to.mission_id, row_kind::response, at.to.assignment_id, mission::to_text(body));
  return {.body = mission::to_text(is_new ? mission::receipt{1, 0} : mission::receipt{0, 1}), .headers = {}};
}

} // namespace

answer get_assignments(service_file& file, const call& at) {
  return {.body = assignments_after(file, at.to.mission_id, at.to.after), .headers = {}};
}

answer empty_assignments() { return {.body = R"({"assignments":[]})", .headers = {}}; }

answer post_response(service_file& file, const call& at) {
  return post_once<mission::assignment_response>(
      file, at, [&](const mission::assignment_response& body) { return take_response(file, at, body); });
}

} // namespace godwit::sim::missions
