#include "actors/executor/remaining.hpp"

#include <algorithm>

#include "actors/domain/control_authority/mode_tables.hpp"
#include "actors/domain/mission/commands/item_class.hpp"
#include "actors/domain/mission/rules.hpp"
#include "actors/executor/plan/mission_look.hpp"
#include "actors/executor/plan/vehicle_items.hpp"

namespace godwit::executor {

std::optional<std::string> last_done(const state& s) {
  if (!s.mission || !s.progress.plan || s.progress.plan->map.items.empty())
    return std::nullopt;
  const auto& items = s.progress.plan->map.items;
  const auto& generation = s.progress.plan->generation;
  auto resolved = std::min<std::size_t>(generation.resolved, items.size());
  while (generation.moved_to && resolved < items.size() && progress::is_passed(items[resolved], *generation.moved_to))
    ++resolved; // its REACHED may still come
  if (resolved != 0)
    return items[resolved - 1].item_id;
  // What stands before a plan was flown by the one before. The mission may have changed since: the plan's own counts.
  const auto first = items.front().item_index;
  const auto& mission = s.flown ? s.flown->mission : *s.mission;
  return first == 0 || first > mission.items.size() ? std::nullopt : std::optional(id_of(mission.items[first - 1]));
}

const io::mavlink::mission_item_int* last_flown_item(const state& s) {
  if (!s.flown || s.flown->items.empty())
    return nullptr;
  const auto& items = s.flown->items;
  if (const auto& plan = s.progress.plan; plan && progress::end_sequence(plan->map) == items.size())
    if (const auto last = progress::last_movement(plan->map))
      return &items[*last];
  const auto last = std::find_if(items.rbegin(), items.rend(), plan::is_nav);
  return last == items.rend() ? &items.back() : &*last;
}

flight::plan_end end_of_plan(const flight::mode_owner& whose, const state& s) {
  const auto* const last = last_flown_item(s);
  return last == nullptr || !plan::is_nav(*last) ? flight::plan_end{}
                                                 : flight::plan_end_of(whose, last->command, last->seq);
}

std::size_t first_remaining(const mission::document& mission, const std::optional<std::string>& last_done) {
  if (!last_done)
    return 0;
  const auto place = mission::index_of(mission.items, *last_done);
  return place ? *place + 1 : 0;
}

std::size_t first_to_fly(const mission::document& mission, const mission::document& flown,
                         const std::optional<std::string>& last_done) {
  const auto is_new = [&](const mission::item& each) { return !mission::index_of(flown.items, id_of(each)); };
  const auto first_new = std::find_if(mission.items.begin(), mission.items.end(), is_new);
  return std::min(first_remaining(mission, last_done), static_cast<std::size_t>(first_new - mission.items.begin()));
}

namespace {

std::uint32_t lines_done(const state& s, const plan::planned_survey& survey) {
  const auto& generation = s.progress.plan->generation;
  return generation.is_armed ? plan::lines_done_at(survey, generation.current) : survey.lines_before;
}

// The item at INDEX is a survey that an earlier plan was sent away from; laid the same way.
bool is_left(const state& s, const mission::document& mission, std::size_t index) {
  const auto* const area = std::get_if<mission::survey>(&mission.items[index]);
  const auto& left = s.flown->left;
  return area != nullptr && left && left->area == *area && left->from == plan::place_before(mission, index);
}

// In the plan on the vehicle. Null: that has no survey there, or lays it in another way.
const plan::planned_survey* survey_on_vehicle(const state& s, const mission::document& mission, std::size_t index) {
  const auto& flown = s.flown->mission.items;
  const auto found = std::ranges::find(s.flown->surveys, index, &plan::planned_survey::item_index);
  const auto end = static_cast<std::ptrdiff_t>(index) + 1;
  const bool is_same = found != s.flown->surveys.end() && index < flown.size() &&
                       std::equal(flown.begin(), flown.begin() + end, mission.items.begin());
  return is_same ? &*found : nullptr;
}

const progress::begun_line* line_under_way(const state& s) {
  return s.progress.mission && s.progress.mission->line ? &*s.progress.mission->line : nullptr;
}

} // namespace

std::optional<progress::begun_line> line_begun(const state& s, const mission::document& mission, std::size_t index) {
  const auto* const line = line_under_way(s);
  if (line == nullptr || !s.flown || !s.progress.plan)
    return std::nullopt;
  const auto now = mission::index_of(mission.items, line->item_id);
  if (!now || *now < index)
    return std::nullopt;
  // The way to another item begins at one that is flown, and the planner compares where the picture was taken.
  const bool is_survey = std::holds_alternative<mission::survey>(mission.items[*now]);
  const bool is_laid_so = !is_survey || survey_on_vehicle(s, mission, *now) != nullptr || is_left(s, mission, *now);
  return is_laid_so ? std::optional(*line) : std::nullopt;
}

std::optional<left_survey> survey_left(const state& s) {
  if (!s.flown || !s.progress.plan)
    return std::nullopt;
  for (const auto& each : s.flown->surveys) {
    const auto lines = lines_done(s, each);
    const auto* const line = line_under_way(s);
    const bool is_begun = line != nullptr && line->item_id == id_of(s.flown->mission.items.at(each.item_index));
    if ((lines > 0 || is_begun) && lines < each.lines_before + each.line_count)
      return left_survey{std::get<mission::survey>(s.flown->mission.items.at(each.item_index)),
                         plan::place_before(s.flown->mission, each.item_index), lines};
  }
  return s.flown->left;
}

std::optional<io::mavlink::mission_item_int> camera_to_stop(const state& s) {
  if (!s.flown || !s.progress.plan || !s.status.in_flight)
    return std::nullopt;
  const auto& generation = s.progress.plan->generation;
  return plan::camera_to_stop(s.flown->items, generation.moved_to.value_or(generation.current));
}

std::uint32_t lines_flown(const state& s, const mission::document& mission, std::size_t index) {
  if (index >= mission.items.size() || !s.flown || !s.progress.plan)
    return 0;
  if (const auto* const survey = survey_on_vehicle(s, mission, index))
    return lines_done(s, *survey);
  return is_left(s, mission, index) ? s.flown->left->lines : 0;
}

tl::expected<reassigned, std::string> reassign(const mission::document& mission, const mission::assignment& assignment,
                                               const std::optional<std::string>& last_done) {
  if (assignment.base_revision != mission.revision)
    return tl::make_unexpected("it is meant for revision " + std::to_string(assignment.base_revision) +
                               " of the mission, and the vehicle flies revision " + std::to_string(mission.revision));
  std::size_t kept = 0;
  if (assignment.replace_after_item_id) {
    const auto place = mission::index_of(mission.items, *assignment.replace_after_item_id);
    if (!place)
      return tl::make_unexpected("the mission has no item '" + *assignment.replace_after_item_id +
                                 "' after which items could be replaced");
    kept = *place + 1;
  }
  reassigned result{mission, 0};
  result.mission.revision = assignment.revision;
  auto& items = result.mission.items;
  items.resize(kept);
  items.insert(items.end(), assignment.items.begin(), assignment.items.end());
  if (const auto problems = mission::broken_rules(result.mission); !problems.empty())
    return tl::make_unexpected("the mission would break a rule: " + problems.front().message());
  result.first_item = std::min(first_remaining(mission, last_done), kept);
  return result;
}

} // namespace godwit::executor
