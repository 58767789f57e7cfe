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
  std::vector<ignored_item> ignored; // 5000 rows at most, both together
  GODWIT_FIELDS(load_page, "mapobjects_store.load_page", load, number, objects, ignored);
};

// All pages are there: from now on this is the map. Said again, it is a repetition.
struct finish_load {
  std::int64_t load = 0;
  std::int64_t objects = 0; // on all pages together; a load with another number is refused
  std::int64_t ignored = 0;
  std::int64_t at_ns = 0; // since 1970 (UTC)
  GODWIT_FIELDS(finish_load, "mapobjects_store.finish_load", load, objects, ignored, at_ns);
};

struct load_answer {
  std::int64_t load = 0;
  map_failure failure = map_failure::none; // load_given_up: begin anew
  std::string error;
  GODWIT_FIELDS(load_answer, "mapobjects_store.load_answer", load, failure, error);
};

} // namespace godwit::mapobjects_store
