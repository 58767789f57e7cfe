#include "actors/mapobjects_store/orphans.hpp"

#include "actors/mapobjects_store/input_check.hpp"

namespace godwit::mapobjects_store {

namespace {

struct orphan_statements {
  const char* copy_to_orphans;
  const char* leave_queue;
  const char* requeue;
  const char* drop_requeued;
};

constexpr orphan_statements all_statements[] = {
    {.copy_to_orphans = "INSERT INTO orphaned_observation SELECT number, id, mission_id, object_id, kind, class_group, "
                        "latitude_deg, longitude_deg, altitude_m, at_ns, confidence, batch, ?2, ?3 "
                        "FROM observation WHERE mission_id = ?1 AND delivery IN ('pending', 'taken')",
     .leave_queue = "DELETE FROM observation WHERE mission_id = ? AND delivery IN ('pending', 'taken')",
     .requeue = "INSERT INTO observation SELECT number, id, mission_id, object_id, kind, class_group, latitude_deg, "
                "longitude_deg, altitude_m, at_ns, confidence, 'pending', NULL FROM orphaned_observation "
                "WHERE batch IS NULL AND (mission_id = ?1 OR ?1 = '')",
     .drop_requeued = "DELETE FROM orphaned_observation WHERE batch IS NULL AND (mission_id = ?1 OR ?1 = '')"},
    {.copy_to_orphans = "INSERT INTO orphaned_ignored_item SELECT number, id, mission_id, mgrs_cell, class_group, "
                        "since_ns, batch, ?2, ?3 FROM ignored_item "
                        "WHERE mission_id = ?1 AND delivery IN ('pending', 'taken')",
     .leave_queue = "UPDATE ignored_item SET delivery = 'orphaned', batch = NULL "
                    "WHERE mission_id = ? AND delivery IN ('pending', 'taken')",
     .requeue = "INSERT INTO ignored_item SELECT number, id, 0, mission_id, mgrs_cell, class_group, since_ns, "
                "'pending', NULL FROM orphaned_ignored_item WHERE batch IS NULL AND (mission_id = ?1 OR ?1 = '') "
                "ON CONFLICT DO UPDATE SET delivery = 'pending'",
     .drop_requeued = "DELETE FROM orphaned_ignored_item WHERE batch IS NULL AND (mission_id = ?1 OR ?1 = '')"}};

} // namespace

map_result<std::uint64_t> orphan(map_tables& t, const orphan_mission& asked) {
  if (auto sound = check_id(asked.mission_id, "mission_id"); !sound)
    return tl::unexpected(std::move(sound.error()));
  std::uint64_t rows = 0;
  for (const auto& each : all_statements) {
    auto done = t.q.run(each.copy_to_orphans, asked.mission_id, asked.at_ns, asked.reason);
    rows += static_cast<std::uint64_t>(t.q.changes());
    if (done)
      done = t.q.run(each.leave_queue, asked.mission_id);
    if (!done)
      return tl::unexpected(std::move(done.error()));
  }
  return t.q.run("UPDATE batch SET state = 'orphaned' WHERE mission_id = ? AND state = 'taken'", asked.mission_id)
      .map([&] { return rows; });
}

map_result<std::uint64_t> requeue(map_tables& t, const requeue_mission& asked) {
  std::uint64_t rows = 0;
  for (const auto& each : all_statements) {
    auto done =
        t.q.run(each.requeue, asked.mission_id).and_then([&] { return t.q.run(each.drop_requeued, asked.mission_id); });
    if (!done)
      return tl::unexpected(std::move(done.error()));
    rows += static_cast<std::uint64_t>(t.q.changes());
  }
  return rows;
}

} // namespace godwit::mapobjects_store
