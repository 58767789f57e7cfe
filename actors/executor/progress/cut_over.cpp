#include "actors/executor/progress/cut_over.hpp"

#include <algorithm>
#include <utility>

#include "actors/executor/progress/advance.hpp"
#include "actors/executor/progress/follow.hpp"
#include "actors/executor/progress/open_mission.hpp"
#include "runtime/assert.hpp"

namespace godwit::executor::progress {

namespace {

void answer_accepted(decision_context& t, const pending_upload& upload) {
  if (!upload.intent.assignment)
    return;
  t.out.emplace_back(assignment_answered{.mission_id = t.s.mission->mission_id,
                                         .assignment_id = upload.intent.assignment->assignment_id,
                                         .response = {.idempotency_key = upload.intent.assignment->idempotency_key,
                                                      .outcome = mission::assignment_outcome::accepted,
                                                      .reason = {},
                                                      .last_progress = t.s.mission->last_report,
                                                      .generation = upload.generation}});
}

// Of the old plan: what nobody did and the new plan, which goes on after it, does not contain. Of another revision it
// is not known whether the items are still in the mission.
std::vector<mapped_item> left_out(const state& s, const pending_upload& upload) {
  std::vector<mapped_item> result;
  if (!s.plan || upload.intent.revision != s.mission->revision || is_way_home(upload.intent.map))
    return result;
  const auto& old = *s.plan;
  const auto& map = upload.intent.map;
  const auto goes_on_at = map.items[std::min<std::size_t>(map.items_before, map.items.size() - 1)].item_index;
  for (auto i = old.ever_resolved; i < old.map.items.size() && old.map.items[i].item_index < goes_on_at; ++i)
    result.push_back(old.map.items[i]);
  return result;
}

// Nothing that is heard after a way home is progress of the mission.
void end_mission(decision_context& t) {
  take(t, mission_aborted{});
  t.s.paused = pause_reason::aborted;
}

} // namespace

void cut_over(decision_context& t, std::optional<std::uint32_t> plan_id) {
  GODWIT_ASSERT(t.s.upload && t.s.mission, "only a pending upload of an open mission is cut over to");
  catch_up(t);
  auto upload = *std::exchange(t.s.upload, std::nullopt);
  GODWIT_ASSERT(upload.generation == t.s.last_generation + 1, "an upload opens the next generation");
  answer_accepted(t, upload);
  const auto skipped = left_out(t.s, upload);
  t.s.mission->revision = upload.intent.revision;
  if (is_way_home(upload.intent.map))
    end_mission(t);
  else
    t.s.paused.reset();
  const auto start = upload.intent.map.start_sequence;
  // The same content: PX4 goes on where it is, and repeats the MISSION_ITEM_REACHED that it has repeated before.
  const bool is_same = plan_id && t.s.plan && t.s.plan->vehicle_plan_id == plan_id;
  const auto last_reached = is_same ? t.s.plan->last_reached : std::nullopt;
  const auto items_before = upload.intent.map.items_before;
  t.s.plan = followed_plan{.map = std::move(upload.intent.map),
                           .vehicle_plan_id = plan_id == 0U ? std::nullopt : plan_id,
                           .id_before = upload.intent.id_before,
                           .last_reached = last_reached,
                           .ever_resolved = items_before,
                           .generation = {}};
  open_generation(t, is_same ? generation_origin::same_plan : generation_origin::new_plan, start, skipped);
  release_held(t);
}

} // namespace godwit::executor::progress
