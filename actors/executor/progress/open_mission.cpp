#include "actors/executor/progress/open_mission.hpp"

#include <algorithm>
#include <utility>

#include "actors/executor/progress/advance.hpp"
#include "actors/executor/progress/follow.hpp"
#include "runtime/assert.hpp"

namespace godwit::executor::progress {

namespace {

void put_away(state& s, mission_record record) {
  if (s.past_missions.size() == max_past_missions)
    s.past_missions.erase(s.past_missions.begin());
  s.past_missions.push_back(std::move(record));
}

mission_record& record_of(state& s, const std::string& mission_id) {
  if (s.mission && s.mission->mission_id == mission_id)
    return *s.mission;
  const auto known = std::ranges::find(s.past_missions, mission_id, &mission_record::mission_id);
  if (known != s.past_missions.end())
    return *known;
  put_away(s, {.mission_id = mission_id, .last_report = {}, .completed_revision = {}});
  return s.past_missions.back();
}

// The item of LAST in the plan. Absent: it is about the mission as a whole, or the plan does not have it.
std::optional<std::uint32_t> position_of(const plan_map& map, const mission::progress_report& last) {
  const auto known = std::ranges::find(map.items, last.item_id.value_or(""), &mapped_item::item_id);
  if (known == map.items.end() || known->sequence_count == 0)
    return std::nullopt;
  return static_cast<std::uint32_t>(known - map.items.begin());
}

// The plan that is followed was begun, and the service knows its items up to LAST: from there on it counts.
void count_from(decision_context& t, const mission::progress_report& last) {
  auto& plan = *t.s.plan;
  auto& g = plan.generation;
  if (last.kind == mission::progress_kind::complete) {
    g.resolved = static_cast<std::uint32_t>(plan.map.items.size());
    g.is_finished = true;
    tell(t, progress_event_kind::plan_done);
  } else if (const auto position = position_of(plan.map, last)) {
    const auto& item = plan.map.items[*position];
    const bool is_begun = last.kind == mission::progress_kind::started;
    g.resolved = std::max(g.resolved, is_begun ? *position : *position + 1);
    if (is_begun)
      g.started_position = position;
    const auto there = is_begun ? item.first_nav_sequence.value_or(item.first_sequence) : done_sequence(item);
    g.current = g.is_armed ? std::max(g.current, there) : there;
    g.is_armed = true;
    if (g.moved_to && *g.moved_to <= g.current)
      g.moved_to.reset();
  }
  plan.ever_resolved = std::max(plan.ever_resolved, g.resolved);
  if (!t.s.upload && !t.s.start)
    finish_if_done(t, true); // the last item was told, and that it was the last was not
}

// What waits to be told of the plan is not told any more.
void stop_counting(decision_context& t, pause_reason why) {
  t.s.plan->generation.moved_to.reset();
  t.s.plan->generation.complete_upto.reset();
  pause(t, why);
}

mission_record take_out(state& s, const mission_opened& what) {
  const auto known = std::find_if(s.past_missions.begin(), s.past_missions.end(),
                                  [&](const auto& each) { return each.mission_id == what.mission_id; });
  if (known == s.past_missions.end())
    return {.mission_id = what.mission_id, .revision = what.revision, .last_report = {}, .completed_revision = {}};
  auto result = std::move(*known);
  s.past_missions.erase(known);
  result.revision = what.revision;
  return result;
}

} // namespace

void take(decision_context& t, const mission_opened& what) {
  GODWIT_ASSERT(!t.s.upload && !t.s.start, "a mission is opened when no intent is under way");
  if (t.s.mission && t.s.mission->mission_id == what.mission_id)
    return;
  catch_up(t);
  auto opened = take_out(t.s, what);
  if (t.s.mission)
    put_away(t.s, std::move(*t.s.mission));
  t.s.mission = std::move(opened);
  t.s.plan.reset();
  t.s.paused.reset();
}

// A process with an older journal finds its mission further than it knew: what was told is not told again.
void take(decision_context& t, const earlier_reports_told& what) {
  auto& record = record_of(t.s, what.mission_id);
  const bool has_more = what.last_report_no > record.report_no;
  record.report_no = std::max(record.report_no, what.last_report_no);
  if (!what.last_report || !(has_more || what.last_report->generation > t.s.last_generation))
    return;
  const auto& last = *what.last_report;
  record.last_report = last;
  if (last.kind == mission::progress_kind::complete)
    record.completed_revision = std::max(record.completed_revision.value_or(0), last.revision);
  const bool is_older = last.generation < t.s.last_generation;
  t.s.last_generation = std::max(t.s.last_generation, last.generation);
  if (t.s.upload)
    t.s.upload->generation = t.s.last_generation + 1;
  if (!t.s.plan)
    return;
  t.s.plan->generation.number = t.s.last_generation;
  if (!t.s.mission || &record != &*t.s.mission || is_older || last.revision < record.revision)
    return;
  if (last.kind == mission::progress_kind::aborted)
    stop_counting(t, pause_reason::aborted);
  else if (last.revision > record.revision)
    stop_counting(t, pause_reason::foreign_plan); // it has brought that plan itself, and does not know it any more
  else
    count_from(t, last);
}

void take(decision_context& t, const mission_aborted&) {
  catch_up(t);
  if (!t.s.mission || t.s.paused == pause_reason::aborted || t.s.mission->completed_revision == t.s.mission->revision)
    return;
  report_mission(t, mission::progress_kind::aborted, false);
  pause(t, pause_reason::aborted);
}

} // namespace godwit::executor::progress
