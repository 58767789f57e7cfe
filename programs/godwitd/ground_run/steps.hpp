// What the run on the ground wants done, in this order. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace godwit::ground_run {

struct begin_fetch {}; // tell mission_client to fetch the mission
struct choose {};      // tell the map store which mission it is: there is no mission_client that would
struct look {};        // ask mission_client how far it is
struct see {};         // let the sightings flow
struct push {};        // tell mission_client that the flight is over
struct count_owed {};  // ask the map store whether anything is left
struct begin_later {}; // after retry_after

// For people; a warning asks for a person.
struct announce {
  std::string sentence;
  bool is_warning = false;
};

// The program ends.
struct finish {
  bool well = true;
  std::string why; // a sentence for people; empty when all is well
};

using step = std::variant<begin_fetch, choose, look, see, push, count_owed, begin_later, announce, finish>;
using steps = std::vector<step>;

} // namespace godwit::ground_run
