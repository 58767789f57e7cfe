#include "actors/executor/flight/watches/survey_view.hpp"

#include <algorithm>
#include <variant>

namespace godwit::executor {

bool scans(const state& s, scan_policy wanted) {
  if (wanted != scan_policy::with_survey || !s.mission)
    return wanted == scan_policy::all && s.mission;
  return std::ranges::any_of(s.mission->items,
                             [](const auto& each) { return std::holds_alternative<mission::survey>(each); });
}

std::optional<scan_controller::survey_progress> survey_progress_of(const state& s) {
  const auto& plan = s.progress.plan;
  if (!s.status.in_flight || !s.flown || !plan || !plan->generation.is_armed)
    return std::nullopt;
  const auto& generation = plan->generation;
  scan_controller::survey_progress result;
  result.mission_id = s.flown->mission.mission_id;
  result.generation = generation.number;
  result.is_flying = s.status.now == phase::flying || s.status.now == phase::pausing;
  // The last one that has begun.
  const auto& surveys = s.flown->surveys;
  const auto next =
      std::ranges::find_if(surveys, [&](const auto& each) { return each.first_line_sequence > generation.current; });
  if (next == surveys.begin())
    return result;
  const auto& survey = *(next - 1);
  const auto& items = s.flown->mission.items;
  const auto* const item =
      survey.item_index < items.size() ? std::get_if<mission::survey>(&items[survey.item_index]) : nullptr;
  if (item == nullptr)
    return result;
  result.item_id = item->id;
  result.polygon = item->polygon;
  result.lines = survey.lines_before + survey.line_count;
  result.lines_done = generation.is_finished ? result.lines : plan::lines_done_at(survey, generation.current);
  result.is_at_beginning = survey.lines_before == 0 && generation.current == survey.first_line_sequence;
  return result;
}

} // namespace godwit::executor
