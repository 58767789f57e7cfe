#include "actors/scan_controller/pass_watch.hpp"

#include <string>
#include <utility>

#include "actors/domain/uuid/uuid.hpp"

namespace godwit::scan_controller {
namespace {

constexpr std::uint64_t passes = 0x706173736573; // keeps their ids apart from whatever else follows from a mission

// As many as the map takes of an area.
constexpr std::size_t max_vertices = 256;

bool is_same_survey(const open_pass& open, const survey_progress& seen) {
  return open.mission_id == seen.mission_id && open.item_id == seen.item_id && open.generation == seen.generation;
}

bool is_beginning(const survey_progress& seen) {
  return !seen.item_id.empty() && seen.is_flying && seen.is_at_beginning && seen.lines > 0 && seen.lines_done == 0;
}

// Null: it goes on.
const char* why_lost(const state& s, const survey_progress& seen, std::uint64_t process, instant now) {
  const auto& open = *s.pass;
  if (open.process != process)
    return "godwitd was started again in it";
  if (!is_same_survey(open, seen))
    return "the plan was changed or started again in it";
  if (!seen.is_flying && seen.lines_done < seen.lines)
    return "the vehicle was held, or somebody else had it";
  if (seen.lines_done < open.lines_done || seen.lines_done > open.lines_done + 1 || seen.lines != open.lines)
    return "not all of its lines were flown";
  if (now.wall_ns < open.started_wall_ns)
    return "the clock was set back in it";
  if (seen.polygon.size() < 3 || seen.polygon.size() > max_vertices)
    return "its area has too many corners for the map";
  return s.owed_passes.size() >= max_owed_passes ? "the map has not taken the passes before" : nullptr;
}

mapobjects_store::pass_end end_of(const open_pass& open, const settings& configured, const survey_progress& seen,
                                  instant now) {
  mapobjects_store::pass_end result;
  result.id =
      ids::derived_uuid(open.mission_id, ids::text_of({passes, static_cast<std::uint64_t>(open.started_wall_ns)}));
  result.mission_id = open.mission_id;
  result.started_ns = open.started_wall_ns;
  result.ended_ns = now.wall_ns;
  result.class_groups = configured.looks_for;
  result.confidence = configured.pass_confidence;
  auto& area = result.polygons.emplace_back();
  for (const auto& each : seen.polygon)
    area.vertices.push_back({each.latitude, each.longitude, {}});
  return result;
}

std::optional<fact> go_on(const state& s, const settings& configured, const survey_progress& seen,
                          std::uint64_t process, instant now) {
  const auto& open = *s.pass;
  if (const char* why = why_lost(s, seen, process, now))
    return pass_lost{why};
  if (seen.lines_done == open.lines_done)
    return {};
  if (seen.lines_done < seen.lines)
    return pass_advanced{seen.lines_done};
  return pass_completed{{end_of(open, configured, seen, now), now.monotonic_ns + pass_settles_ns}};
}

} // namespace

void view_watch::on_view(const view& said, std::int64_t now_ns) {
  reason = said.reason;
  seen_until_ns = said.is_seeing ? now_ns + view_lasts_ns : 0;
}

std::optional<fact> on_view(const state& s, const settings& configured, const view_watch& watch, std::int64_t now_ns) {
  const bool is_needed = configured.watches_view && s.pass && !s.pass->is_over && watch.is_on_lines;
  if (!is_needed || now_ns < watch.seen_until_ns)
    return {};
  return pass_lost{"the camera has not seen all of it" + (watch.reason.empty() ? "" : ": " + watch.reason)};
}

std::optional<fact> on_survey(const state& s, const settings& configured, const survey_progress& now_at,
                              std::uint64_t process, instant now) {
  if (configured.looks_for.empty())
    return {};
  if (s.pass && !s.pass->is_over)
    return go_on(s, configured, now_at, process, now);
  if (!is_beginning(now_at) || (s.pass && is_same_survey(*s.pass, now_at)))
    return {};
  open_pass begun{now_at.mission_id, now_at.item_id, now_at.generation};
  begun.lines = now_at.lines;
  begun.process = process;
  begun.started_wall_ns = now.wall_ns;
  return pass_begun{std::move(begun)};
}

} // namespace godwit::scan_controller
