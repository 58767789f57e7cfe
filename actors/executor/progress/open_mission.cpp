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

void take(decision_context& t, const earlier_reports_told& what) {
  auto& record = record_of(t.s, what.mission_id);
  if (what.last_report_no <= record.report_no)
    return;
  record.report_no = what.last_report_no;
  if (!what.last_report)
    return;
  record.last_report = what.last_report;
  if (what.last_report->kind == mission::progress_kind::complete)
    record.completed_revision = std::max(record.completed_revision.value_or(0), what.last_report->revision);
  t.s.last_generation = std::max(t.s.last_generation, what.last_report->generation);
}

void take(decision_context& t, const mission_aborted&) {
  catch_up(t);
  if (!t.s.mission || t.s.paused == pause_reason::aborted || t.s.mission->completed_revision == t.s.mission->revision)
    return;
  report_mission(t, mission::progress_kind::aborted, false);
  pause(t, pause_reason::aborted);
}

} // namespace godwit::executor::progress
