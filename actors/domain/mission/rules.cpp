#include "actors/domain/mission/rules.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "actors/domain/mission/item_rules.hpp"
#include "actors/domain/mission/polygon_rules.hpp"
#include "actors/domain/mission/utc_text.hpp"

namespace godwit::mission {

namespace {

void add_time_problem(const std::string& text, std::string pointer, document_problems& problems) {
  if (!time_of_utc_text(text))
    problems.push_back({std::move(pointer), "is " + in_quotes(text), "a day and time that exist, from 1678 to 2261"});
}

void add_version_problem(const std::string& version, document_problems& problems) {
  if (!is_known_version(version))
    problems.push_back({"/schema_version", "is " + in_quotes(version), std::string(known_versions)});
}

void add_item_version_problem(const document& value, document_problems& problems) {
  if (!needs_version_2(value) || !value.schema_version.starts_with("1."))
    return;
  const auto newer = std::ranges::find_if(value.items, is_of_version_2);
  const auto why =
      newer == value.items.end()
          ? std::string("circles, rally points, a point of return of the fence and a vehicle are of version 2")
          : "item " + in_quotes(id_of(*newer)) + " is of kind " + std::string(kind_of(*newer));
  problems.push_back(
      {"/schema_version", "is " + in_quotes(value.schema_version) + ", and " + why, std::string(schema_version_2)});
}

void add_fence_problems(const geofence& fence, const std::string& pointer, document_problems& problems) {
  if (auto fault = fence_fault(fence.vertices))
    problems.push_back({pointer_to(pointer, "vertices"), std::move(*fault), "at least 3 different corners"});
  if (fence.floor_m && fence.ceiling_m && !(*fence.floor_m < *fence.ceiling_m))
    problems.push_back({pointer_to(pointer, "floor_m"), "is not below ceiling_m", "a floor below the ceiling"});
}

bool leads_to_return_point(const item& each) {
  const auto* const back = std::get_if<return_home>(&each);
  return back != nullptr && !back->to;
}

void add_return_problems(const document& value, document_problems& problems) {
  if (value.return_point)
    add_position_problems(*value.return_point, "/return_point", problems);
  else if (std::ranges::any_of(value.items, leads_to_return_point))
    problems.push_back({"/return_point", "is missing", "a position: an item returns there"});
  if (value.planned_home)
    add_position_problems(*value.planned_home, "/planned_home", problems);
  if (value.breach_return_point)
    add_position_problems(*value.breach_return_point, "/breach_return_point", problems);
  if (value.rally_points)
    for (std::size_t i = 0; i < value.rally_points->size(); ++i)
      add_position_problems((*value.rally_points)[i], pointer_to("/rally_points", i), problems);
}

void add_assignment_problems(const assignment& value, const std::string& pointer, document_problems& problems) {
  if (value.revision <= value.base_revision)
    problems.push_back(
        {pointer_to(pointer, "revision"),
         "is " + std::to_string(value.revision) + ", and base_revision " + std::to_string(value.base_revision),
         "a revision above base_revision"});
  add_item_problems(value.items, pointer_to(pointer, "items"), problems);
}

// An item is named by id and index, or not at all: the one without the other comes from a defect.
void add_report_problems(const progress_report& report, const std::string& pointer, document_problems& problems) {
  add_time_problem(report.at, pointer_to(pointer, "at"), problems);
  if (report.item_id.has_value() != report.item_index.has_value())
    problems.push_back({pointer, "has only one of item_id and item_index", "both or none"});
  if (settles_item(report.kind) && !report.item_id)
    problems.push_back({pointer, "does not name its item", "item_id and item_index"});
}

template <class Rows, class Id>
void add_repeated_rows(const Rows& rows, Id id, std::string_view list, std::string_view name,
                       document_problems& problems) {
  std::set<std::string_view> seen;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!seen.insert(rows[i].*id).second)
      problems.push_back({pointer_to(pointer_to(pointer_to("", list), i), name), "stands twice in this list", {}});
}

void add_map_object_problems(const std::vector<map_object>& rows, document_problems& problems) {
  add_repeated_rows(rows, &map_object::object_id, "map_objects", "object_id", problems);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto pointer = pointer_to("/map_objects", i);
    add_time_problem(rows[i].first_seen, pointer_to(pointer, "first_seen"), problems);
    add_time_problem(rows[i].last_seen, pointer_to(pointer, "last_seen"), problems);
  }
}

void add_ignored_problems(const std::vector<ignored_item>& rows, document_problems& problems) {
  add_repeated_rows(rows, &ignored_item::ignored_id, "ignored_items", "ignored_id", problems);
  for (std::size_t i = 0; i < rows.size(); ++i)
    add_time_problem(rows[i].at, pointer_to(pointer_to("/ignored_items", i), "at"), problems);
}

} // namespace

bool is_known_version(std::string_view version) {
  const auto major = [](std::string_view text) { return text.substr(0, text.find('.')); };
  return major(version) == major(schema_version) || major(version) == major(schema_version_2);
}

document_problems broken_rules(const document& value) {
  document_problems problems;
  add_version_problem(value.schema_version, problems);
  add_item_version_problem(value, problems);
  if (value.items.empty())
    problems.push_back({"/items", "are none", "at least 1"});
  if (value.items.size() > max_items)
    problems.push_back({"/items", "are " + std::to_string(value.items.size()), "up to " + std::to_string(max_items)});
  add_item_problems(value.items, "/items", problems);
  add_jump_problems(value.items, "/items", problems);
  for (std::size_t i = 0; i < value.geofences.size(); ++i)
    add_fence_problems(value.geofences[i], pointer_to("/geofences", i), problems);
  add_return_problems(value, problems);
  return problems;
}

document_problems broken_rules(const assignment& value) {
  document_problems problems;
  add_assignment_problems(value, {}, problems);
  return problems;
}

document_problems broken_rules(const assignment_list& value) {
  document_problems problems;
  for (std::size_t i = 0; i < value.assignments.size(); ++i)
    add_assignment_problems(value.assignments[i], pointer_to("/assignments", i), problems);
  for (std::size_t i = 1; i < value.assignments.size(); ++i)
    if (value.assignments[i].revision <= value.assignments[i - 1].revision)
      problems.push_back({pointer_to(pointer_to("/assignments", i), "revision"), "is not above the one before it",
                          "the oldest first"});
  return problems;
}

document_problems broken_rules(const assignment_response& value) {
  document_problems problems;
  if (value.outcome == assignment_outcome::rejected && !value.reason)
    problems.push_back({"/reason", "is missing", "a text, since it was rejected"});
  if (value.last_progress)
    add_report_problems(*value.last_progress, "/last_progress", problems);
  return problems;
}

document_problems broken_rules(const waypoint_insert& value) {
  document_problems problems;
  add_item_problems({&value.waypoint, 1}, "/waypoint", problems);
  return problems;
}

document_problems broken_rules(const tail& value) {
  document_problems problems;
  add_item_problems(value.items, "/items", problems);
  return problems;
}

document_problems broken_rules(const progress_report& value) {
  document_problems problems;
  add_report_problems(value, {}, problems);
  return problems;
}

document_problems broken_rules(const progress_batch& value) {
  document_problems problems;
  for (std::size_t i = 0; i < value.reports.size(); ++i) {
    const auto pointer = pointer_to("/reports", i);
    add_report_problems(value.reports[i], pointer, problems);
    if (i == 0)
      continue;
    const auto& before = value.reports[i - 1];
    if (value.reports[i].report_no != before.report_no + 1)
      problems.push_back(
          {pointer_to(pointer, "report_no"),
           "is " + std::to_string(value.reports[i].report_no) + " after " + std::to_string(before.report_no),
           "numbers without a gap"});
    if (value.reports[i].mission_id != before.mission_id)
      problems.push_back({pointer_to(pointer, "mission_id"), "is another than before", "one mission in a batch"});
  }
  return problems;
}

document_problems broken_rules(const map_object_page& value) {
  document_problems problems;
  add_version_problem(value.schema_version, problems);
  add_map_object_problems(value.map_objects, problems);
  if (!value.since && value.removed)
    problems.push_back({"/removed", "is there without `since`", "ids of what was removed since a mark"});
  return problems;
}

document_problems broken_rules(const ignored_item_page& value) {
  document_problems problems;
  add_version_problem(value.schema_version, problems);
  add_ignored_problems(value.ignored_items, problems);
  return problems;
}

document_problems broken_rules(const observation_batch& value) {
  document_problems problems;
  add_repeated_rows(value.observations, &observation::observation_id, "observations", "observation_id", problems);
  for (std::size_t i = 0; i < value.observations.size(); ++i) {
    const auto pointer = pointer_to("/observations", i);
    const auto& each = value.observations[i];
    add_time_problem(each.at, pointer_to(pointer, "at"), problems);
    if (each.kind != observation_kind::fresh && each.kind != observation_kind::ignored && !each.object_id)
      problems.push_back({pointer_to(pointer, "object_id"), "is missing", "a UUID: only a new one has none"});
  }
  return problems;
}

document_problems broken_rules(const ignored_item_batch& value) {
  document_problems problems;
  add_ignored_problems(value.ignored_items, problems);
  return problems;
}

document_problems broken_rules(const observation_picture& value) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  document_problems problems;
  add_time_problem(value.captured_at, "/captured_at", problems);
  const auto end = value.jpeg.find_first_not_of(digits);
  const auto padding = end == std::string::npos ? std::string_view() : std::string_view(value.jpeg).substr(end);
  if (value.jpeg.size() % 4 != 0 || !(padding.empty() || padding == "=" || padding == "=="))
    problems.push_back({"/jpeg", "is no base64", "a JPEG in base64 (RFC 4648, section 4)"});
  return problems;
}

document_problems broken_rules(const map_object_bundle& value) {
  document_problems problems;
  add_version_problem(value.schema_version, problems);
  add_time_problem(value.fetched_at, "/fetched_at", problems);
  add_map_object_problems(value.map_objects, problems);
  add_ignored_problems(value.ignored_items, problems);
  return problems;
}

document_problems broken_rules(const receipt&) { return {}; }

document_problems broken_rules(const progress_status&) { return {}; }

document_problems broken_rules(const next_mission&) { return {}; }

document_problems broken_rules(const problem&) { return {}; }

} // namespace godwit::mission
