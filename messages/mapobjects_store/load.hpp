// Replacing the map by what the missions service holds, page by page. Each is answered with load_answer. Thread: plain
// values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "messages/mapobjects_store/answer.hpp"
#include "messages/mapobjects_store/object.hpp"

namespace godwit::mapobjects_store {

// Answered with the number of the load. Comes before the first request to the service: what was delivered until now is
// in the answer, what is delivered later may not be. A load that was under way is given up.
struct begin_load {
  std::string mission_id;
  GODWIT_FIELDS(begin_load, "mapobjects_store.begin_load", mission_id);
};

// One page; the next one is sent when it is answered. A page that was put already is a repetition. It is not on the
// disk for sure when it is answered: after a crash of the process a load is given up, and its asker begins anew.
struct load_page {
  std::int64_t load = 0;
  std::int64_t number = 0; // 0, 1, 2, ... in the load
  std::vector<map_object> objects;
  std::vector<ignored_item> ignored;     // 5000 rows at most, all together
  std::vector<std::string> removed = {}; // ids of objects that the copy from before has; with finish_load's is_change
  GODWIT_FIELDS(load_page, "mapobjects_store.load_page", load, number, objects, ignored, removed);
};

// All pages are there: from now on this is the map. Said again, it is a repetition.
struct finish_load {
  std::int64_t load = 0;
  std::int64_t objects = 0; // on all pages together; a load with another number is refused
  std::int64_t ignored = 0;
  std::int64_t at_ns = 0; // since 1970 (UTC)
  bool is_change = false; // the objects replace those of the copy from before, whose others stay; ignored items are all
  std::string mark = {};  // the service's, of what the pages show; empty: it gave none
  GODWIT_FIELDS(finish_load, "mapobjects_store.finish_load", load, objects, ignored, at_ns, is_change, mark);
};

struct load_answer {
  std::int64_t load = 0;
  map_failure failure = map_failure::none; // load_given_up: begin anew
  std::string error;
  std::string mark = {}; // of begin_load: of the copy that this mission has; empty: none
  GODWIT_FIELDS(load_answer, "mapobjects_store.load_answer", load, failure, error, mark);
};

// Which mission the map is for, and what becomes of it and of what is owed when a mission is gone. All may be said
// again. Thread: plain values.

// Answered with map_answer. Comes before the first pull for a mission. For the mission that is chosen already nothing
// changes: after a crash in flight nothing can be pulled.
struct choose_mission {
  std::string mission_id;
  GODWIT_FIELDS(choose_mission, "mapobjects_store.choose_mission", mission_id);
};

// Answered with map_answer. A load that was under way is given up. Refused for a mission that is not the chosen one.
struct pull_failed {
  std::string mission_id;
  GODWIT_FIELDS(pull_failed, "mapobjects_store.pull_failed", mission_id);
};

// Answered with map_answer. The operator goes on with the copy from the last time. Refused for a mission that is not
// the chosen one, or when the map is not degraded (and not acknowledged already).
struct acknowledge_fallback {
  std::string mission_id;
  GODWIT_FIELDS(acknowledge_fallback, "mapobjects_store.acknowledge_fallback", mission_id);
};

// Answered with moved_rows: how many became orphans now. The service has deleted the mission: its map is gone, what
// this vehicle saw for it leaves the map, and what is owed for it is kept aside as orphans. A batch keeps its key.
struct delete_mission {
  std::string mission_id;
  std::int64_t at_ns = 0;
  std::string reason; // for people
  GODWIT_FIELDS(delete_mission, "mapobjects_store.delete_mission", mission_id, at_ns, reason);
};

// Answered with moved_rows. What is owed for the mission is kept aside; the map stays.
struct orphan_mission {
  std::string mission_id;
  std::int64_t at_ns = 0;
  std::string reason; // for people
  GODWIT_FIELDS(orphan_mission, "mapobjects_store.orphan_mission", mission_id, at_ns, reason);
};

// Answered with moved_rows. By a person's will: orphans that are in no batch are pending again. Those in a batch are
// delivered under its key (see get_batches).
struct requeue_mission {
  std::string mission_id; // empty = all missions
  GODWIT_FIELDS(requeue_mission, "mapobjects_store.requeue_mission", mission_id);
};

struct moved_rows {
  std::uint64_t rows = 0;
  map_failure failure = map_failure::none;
  std::string error;
  GODWIT_FIELDS(moved_rows, "mapobjects_store.moved_rows", rows, failure, error);
};

} // namespace godwit::mapobjects_store
