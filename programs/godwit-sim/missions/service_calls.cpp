#include "programs/godwit-sim/missions/service_calls.hpp"

#include <algorithm>

#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/utc_text.hpp"
#include "actors/domain/mission/write.hpp"
#include "messages/mission/answer.hpp"
#include "programs/godwit-sim/missions/assignment_table.hpp"
#include "programs/godwit-sim/missions/delivered_table.hpp"
#include "programs/godwit-sim/missions/exchange.hpp"
#include "programs/godwit-sim/missions/mission_table.hpp"

namespace godwit::sim::missions {

namespace {

answer page_answer(service_file& file, const call& at, page_kind kind) {
  auto made = page(file, at.mission, kind, {at.to.next, at.to.limit, at.to.since});
  if (!made)
    return problem_answer(400, "This `next` is not known, or not any more: begin with the first page.");
  answer result{.body = std::move(made->body), .headers = {}};
  if (!made->next.empty())
    result.headers.push_back({"Next-Page", made->next});
  return result;
}

} // namespace

answer get_map_objects(service_file& file, const call& at) { return page_answer(file, at, page_kind::map_objects); }

answer get_ignored(service_file& file, const call& at) { return page_answer(file, at, page_kind::ignored_items); }

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
  rest_of_items rest;
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

namespace {

std::optional<mission::progress_report> last_report(service_file& file, const mission_row& of) {
  const auto text = row_text(file, of.mission_id, row_kind::progress, std::to_string(of.last_report_no));
  if (!text)
    return std::nullopt;
  auto last = mission::read<mission::progress_report>(*text);
  return last ? std::optional(*std::move(last)) : std::nullopt;
}

bool has_ended(service_file& file, const mission_row& mission) {
  const auto last = last_report(file, mission);
  return last && last->revision >= mission.revision &&
         (last->kind == mission::progress_kind::complete || last->kind == mission::progress_kind::aborted);
}

} // namespace

answer get_next(service_file& file, const call& at) {
  for (const auto& each : live_missions(file))
    if (const auto row = find_mission(file, each); row && !has_ended(file, *row))
      return {.body = mission::to_text(mission::next_mission{at.to.vehicle_id, each}), .headers = {}};
  return {.body = {}, .headers = {}};
}

answer no_next() { return {.status = 204, .content_type = {}, .body = {}, .headers = {}}; }

answer remove_mission(service_file& file, const call& at) {
  file.begin();
  delete_mission(file, at.to.mission_id, mission::utc_text(at.now_ns));
  static_cast<void>(file.commit());
  return {.status = 204, .content_type = {}, .body = {}, .headers = {}};
}

answer post_waypoint(service_file& file, const call& at) {
  return post_once<mission::waypoint_insert>(file, at, [&](const mission::waypoint_insert& body) {
    return change_mission(file, at, body, {body.waypoint}, {rest_of_items::keep, "/waypoint", false});
  });
}

answer post_tail(service_file& file, const call& at) {
  return post_once<mission::tail>(file, at, [&](const mission::tail& body) {
    return change_mission(file, at, body, body.items, {rest_of_items::replace, "/items", true});
  });
}

namespace {

// The mission as ASSIGNMENT makes it. None: it was made for another one.
std::optional<mission::document> taken_over(service_file& file, const call& at, const mission::assignment& assignment) {
  if (assignment.base_revision != at.mission.revision)
    return std::nullopt;
  auto changed = changed_mission(stored_mission(file, at.to.mission_id), assignment.replace_after_item_id,
                                 assignment.items, rest_of_items::replace, "/items");
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

namespace {

answer receipt_answer(const mission::receipt& receipt) { return {.body = mission::to_text(receipt), .headers = {}}; }

void count(mission::receipt& to, bool is_new) { ++(is_new ? to.stored : to.repeated); }

// ROWS, each with its id, under KIND.
template <class Row, class Id>
answer put_rows(service_file& file, const call& at, row_kind kind, const std::vector<Row>& rows, Id id) {
  mission::receipt receipt;
  for (const auto& each : rows)
    count(receipt, put_row(file, at.to.mission_id, kind, each.*id, mission::to_text(each)));
  return receipt_answer(receipt);
}

answer put_reports(service_file& file, const call& at, const std::vector<mission::progress_report>& reports) {
  if (reports.front().mission_id != at.to.mission_id) // the rules say that all of them have the same
    return wrong_place("/reports/0/mission_id", "is " + mission::in_quotes(reports.front().mission_id),
                       "the mission that the request is about");
  const auto last = at.mission.last_report_no;
  if (reports.front().report_no > last + 1)
    return problem_answer(409, "The last report that is there has the number " + std::to_string(last) +
                                   ", and the first of these " + std::to_string(reports.front().report_no) + ".");
  for (std::size_t i = 0; i < reports.size(); ++i)
    if (const auto& id = reports[i].item_id; id && !knows_item(file, at.to.mission_id, *id))
      return wrong_place("/reports/" + std::to_string(i) + "/item_id", "is " + mission::in_quotes(*id),
                         "an item that the mission has or had");
  mission::receipt receipt;
  for (const auto& each : reports)
    count(receipt,
          put_row(file, at.to.mission_id, row_kind::progress, std::to_string(each.report_no), mission::to_text(each)));
  set_last_report(file, at.to.mission_id, std::max<std::int64_t>(last, reports.back().report_no));
  return receipt_answer(receipt);
}

} // namespace

answer get_progress(service_file& file, const call& at) {
  const mission::progress_status told{static_cast<std::uint32_t>(at.mission.last_report_no),
                                      last_report(file, at.mission)};
  return {.body = mission::to_text(told), .headers = {}};
}

answer post_progress(service_file& file, const call& at) {
  return post_once<mission::progress_batch>(
      file, at, [&](const mission::progress_batch& body) { return put_reports(file, at, body.reports); });
}

answer post_map_objects(service_file& file, const call& at) {
  return post_once<mission::observation_batch>(file, at, [&](const mission::observation_batch& body) {
    return put_rows(file, at, row_kind::observation, body.observations, &mission::observation::observation_id);
  });
}

answer post_ignored(service_file& file, const call& at) {
  return post_once<mission::ignored_item_batch>(file, at, [&](const mission::ignored_item_batch& body) {
    return put_rows(file, at, row_kind::ignored_item, body.ignored_items, &mission::ignored_item::ignored_id);
  });
}

answer post_picture(service_file& file, const call& at) {
  return post_once<mission::observation_picture>(file, at, [&](const mission::observation_picture& body) {
    return put_rows(file, at, row_kind::picture, std::vector{body}, &mission::observation_picture::observation_id);
  });
}

} // namespace godwit::sim::missions
