#include "programs/godwit-sim/missions/mission_calls.hpp"

#include "actors/domain/mission/utc_text.hpp"
#include "actors/domain/mission/write.hpp"
#include "programs/godwit-sim/missions/change.hpp"
#include "programs/godwit-sim/missions/delivered_table.hpp"
#include "programs/godwit-sim/missions/once.hpp"

namespace godwit::sim::missions {
namespace {

answer stale(const mission_row& mission, std::int32_t base_revision) {
  return problem_answer(409, "The mission is at revision " + std::to_string(mission.revision) +
                                 ", and the change was meant for " + std::to_string(base_revision) + ".");
}

answer refusal(const change_error& error) {
  if (const auto* missing = std::get_if<missing_item>(&error))
    return problem_answer(409, "The mission has no item " + mission::in_quotes(missing->id) + ".");
  return problem_answer({mission::document_errc::broken_rule, std::get<1>(error)});
}

// How an insert differs from a tail.
struct change_form {
  behind rest;
  std::string pointer;
  bool is_list;
};

// BODY is an insert or a tail, ITEMS what it brings.
template <class Body>
answer change_mission(service_file& file, const call& at, const Body& body, const std::vector<mission::item>& items,
                      const change_form& form) {
  if (body.base_revision != at.mission.revision)
    return stale(at.mission, body.base_revision);
  auto changed = changed_mission(stored_mission(file, at.to.mission_id), body.after_item_id, items, form.rest,
                                 form.pointer, form.is_list);
  if (!changed)
    return refusal(changed.error());
  auto reused = note_items(file, at.to.mission_id, items, form.pointer, form.is_list);
  if (!reused.empty())
    return refusal(std::move(reused));
  changed->revision = static_cast<std::int32_t>(at.mission.last_revision + 1);
  replace_mission(file, *changed);
  put_row(file, at.to.mission_id, row_kind::change, body.idempotency_key, mission::to_text(body));
  return {.body = mission::to_text(*changed), .headers = {}};
}

} // namespace

answer get_mission(service_file& file, const call& at) {
  return {.body = mission_text(file, at.to.mission_id), .headers = {}};
}

answer remove_mission(service_file& file, const call& at) {
  file.begin();
  delete_mission(file, at.to.mission_id, mission::utc_text(at.now_ns));
  static_cast<void>(file.commit());
  return {.status = 204, .content_type = {}, .body = {}, .headers = {}};
}

answer post_waypoint(service_file& file, const call& at) {
  return post_once<mission::waypoint_insert>(file, at, [&](const mission::waypoint_insert& body) {
    return change_mission(file, at, body, {body.waypoint}, {behind::keep, "/waypoint", false});
  });
}

answer post_tail(service_file& file, const call& at) {
  return post_once<mission::tail>(file, at, [&](const mission::tail& body) {
    return change_mission(file, at, body, body.items, {behind::replace, "/items", true});
  });
}

} // namespace godwit::sim::missions
