// What is known about missions, and what the map store has to be told.
#include <algorithm>

#include "actors/mission_client/decision_context.hpp"

namespace godwit::mission_client {

namespace {

bool is_forgettable(const state& s, const mission_note& note) {
  return !note.is_pushing && !note.asks_progress && note.mission_id != s.mission_id &&
         std::ranges::none_of(s.rows, [&](const outbox_row& each) { return each.mission_id == note.mission_id; });
}

} // namespace

const mission_note* find_note(const state& s, std::string_view mission_id) {
  const auto found = std::ranges::find(s.missions, mission_id, &mission_note::mission_id);
  return found == s.missions.end() ? nullptr : &*found;
}

mission_note& note_of(state& s, const std::string& mission_id) {
  const auto found = std::ranges::find(s.missions, mission_id, &mission_note::mission_id);
  if (found != s.missions.end())
    return *found;
  if (s.missions.size() >= max_mission_notes) {
    const auto oldest = std::ranges::find_if(s.missions, [&](const auto& each) { return is_forgettable(s, each); });
    if (oldest != s.missions.end())
      s.missions.erase(oldest);
  }
  s.missions.emplace_back().mission_id = mission_id;
  return s.missions.back();
}

void add_store_operation(state& s, store_operation_kind kind, const std::string& mission_id,
                         const std::string& reason) {
  const bool is_known = std::ranges::any_of(s.store_operations, [&](const store_operation& each) {
    return each.kind == kind && each.mission_id == mission_id;
  });
  if (is_known)
    return;
  if (s.store_operations.size() >=
      max_store_operations) // the store has been silent for as many missions; the newest matter most
    s.store_operations.erase(s.store_operations.begin());
  s.store_operations.push_back({kind, mission_id, reason});
}

void resolve(decision_context& t) {
  for (auto& note : t.s.missions) {
    if (!note.is_pushing || !note.seen_done || !note.ignored_done)
      continue;
    const auto counts = count_rows(t.s.rows, note.mission_id);
    if (counts.pending != 0)
      continue;
    note.is_pushing = false;
    if (std::exchange(note.was_asked, false))
      t.tell(mission_resolved{note.mission_id, counts.orphaned, counts.expired});
  }
}

} // namespace godwit::mission_client
