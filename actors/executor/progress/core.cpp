#include "actors/executor/progress/core.hpp"

#include <algorithm>

#include "actors/executor/progress/acts.hpp"
#include "actors/executor/progress/decision_context.hpp"
#include "actors/executor/progress/follow.hpp"
#include "actors/executor/progress/open_mission.hpp"
#include "actors/executor/progress/start.hpp"
#include "actors/executor/progress/upload.hpp"

namespace godwit::executor::progress {

effects apply(state& s, const event& happened, std::int64_t now_ns) {
  effects result;
  decision_context t{s, result, now_ns};
  std::visit([&](const auto& each) { take(t, each); }, happened);
  return result;
}

effects resume(const state& s) {
  effects result;
  if (s.upload)
    result.emplace_back(look_at_vehicle{});
  if (s.start)
    result.emplace_back(resolve_start{s.start->sequence});
  return result;
}

bool matters(const state& s, const event& happened, std::int64_t now_ns) {
  auto after = s;
  return !apply(after, happened, now_ns).empty() || !io::equal(after, s);
}

bool is_at_last_movement(const state& s) {
  if (!s.plan || s.paused)
    return false;
  const auto& g = s.plan->generation;
  const auto last = last_movement(s.plan->map);
  return g.is_armed && !g.is_finished && last && g.moved_to.value_or(g.current) >= *last;
}

bool has_ended(const state& s, std::string_view mission_id, std::int32_t revision) {
  const auto is_ended = [&](const mission_record& each) {
    return each.mission_id == mission_id && ((each.completed_revision && *each.completed_revision >= revision) ||
                                             (was_called_off(each) && each.last_report->revision >= revision));
  };
  return (s.mission && is_ended(*s.mission)) || std::ranges::any_of(s.past_missions, is_ended);
}

bool is_begun(const state& s, std::string_view mission_id) {
  const auto is_open = [&](const mission_record& each) {
    const auto& last = each.last_report;
    return each.mission_id == mission_id && each.report_no != 0 &&
           (!last || (last->kind != mission::progress_kind::complete && last->kind != mission::progress_kind::aborted));
  };
  return (s.mission && is_open(*s.mission)) || std::ranges::any_of(s.past_missions, is_open);
}

std::optional<mission::progress_report> last_progress(const state& s) {
  return s.mission ? s.mission->last_report : std::nullopt;
}

} // namespace godwit::executor::progress
