#include "actors/executor/state_changes.hpp"

#include <algorithm>

namespace godwit::executor {
namespace {

// What we have numbered since counts as BASE, of which the service's next revision is a newer one.
void number_as(state& s, std::int32_t base) {
  if (!s.mission)
    return;
  const auto lower = [base](std::int32_t& revision) { revision = std::min(revision, base); };
  lower(s.mission->revision);
  for (auto* each : {&s.brings, &s.flown})
    if (*each && (*each)->mission.mission_id == s.mission->mission_id)
      lower((*each)->mission.revision);
  auto& open = s.progress.mission;
  if (!open || open->mission_id != s.mission->mission_id)
    return;
  lower(open->revision);
  if (open->completed_revision)
    lower(*open->completed_revision);
  if (s.progress.upload)
    lower(s.progress.upload->intent.revision);
}

} // namespace

durable_core::effect order_for_service(const std::string& mission_id, const mission_change& what) {
  if (what.kind == change_kind::insert)
    return mission_client::insert_waypoint{
        mission_id, {what.key, what.base_revision, what.after_item_id, what.items.front()}, what.is_flown};
  return mission_client::replace_tail{
      mission_id, {what.key, what.base_revision, what.after_item_id, what.items, what.reason}, what.is_flown};
}

void resolve_change(state& s, bool is_done) {
  if (!s.change)
    return;
  const bool has_mission_back = is_done == (s.change->kind == change_kind::cancel);
  if (has_mission_back && s.change->kind != change_kind::insert && s.change->sets_aside)
    s.set_aside.clear();
  s.change.reset();
}

void stop_change(state& s) {
  s.commanded.reset();
  if (!s.change)
    return;
  if (s.arrived)
    s.change->is_stopped = true;
  else
    resolve_change(s, false);
}

bool is_older_than_mission(const state& s, const mission::document& other) {
  const auto& mission = *s.mission;
  if (other.mission_id != mission.mission_id || other.revision != mission.revision)
    return other.mission_id == mission.mission_id && other.revision < mission.revision;
  return s.flown_changes.empty() || s.is_arrived_ours || other == mission;
}

void answer_flown_change(state& s, const change_answered& happened) {
  const auto found = std::ranges::find(s.flown_changes, happened.key, &flown_change::key);
  if (found == s.flown_changes.end())
    return;
  if (happened.has_it) {
    s.flown_changes.erase(s.flown_changes.begin(), found + 1);
    return;
  }
  const auto base = found->revision - 1;
  s.flown_changes.erase(found, s.flown_changes.end());
  number_as(s, base);
  if (s.is_arrived_ours && s.arrived && !s.brings) { // it has come in time: nothing of it is on its way to the vehicle
    s.arrived.reset();
    resolve_change(s, false);
  }
}

} // namespace godwit::executor
