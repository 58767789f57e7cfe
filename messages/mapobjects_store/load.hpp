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
  static constexpr auto fields =
      io::table("mapobjects_store.begin_load", io::field("mission_id", &begin_load::mission_id));
};

// One page; the next one is sent when it is answered. A page that was put already is a repetition. It is not on the
// disk for sure when it is answered: after a crash of the process a load is given up, and its asker begins anew.
struct load_page {
  std::int64_t load = 0;
  std::int64_t number = 0; // 0, 1, 2, ... in the load
  std::vector<map_object> objects;
  std::vector<ignored_item> ignored; // 5000 rows at most, both together
  static constexpr auto fields = io::table(
      "mapobjects_store.load_page", io::field("load", &load_page::load), io::field("number", &load_page::number),
      io::field("objects", &load_page::objects), io::field("ignored", &load_page::ignored));
};

// All pages are there: from now on this is the map. Said again, it is a repetition.
struct finish_load {
  std::int64_t load = 0;
  std::int64_t objects = 0; // on all pages together; a load with another number is refused
  std::int64_t ignored = 0;
  std::int64_t at_ns = 0; // since 1970 (UTC)
  static constexpr auto fields =
      io::table("mapobjects_store.finish_load", io::field("load", &finish_load::load),
                io::field("objects", &finish_load::objects), io::field("ignored", &finish_load::ignored),
                io::field("at_ns", &finish_load::at_ns));
};

struct load_answer {
  std::int64_t load = 0;
  map_failure failure = map_failure::none; // load_given_up: begin anew
  std::string error;
  static constexpr auto fields =
      io::table("mapobjects_store.load_answer", io::field("load", &load_answer::load),
                io::field("failure", &load_answer::failure), io::field("error", &load_answer::error));
};

} // namespace godwit::mapobjects_store
