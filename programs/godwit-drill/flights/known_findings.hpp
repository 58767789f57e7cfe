// Flaws that the drills have found and that are not mended yet; each is entered in docs/roadmap.md.
//
// A flaw is known by its case and by its sentence: anything else that goes wrong in such a flight is a flaw as before.
// Thread: constants.
#pragma once

#include <span>
#include <string_view>

#include "programs/godwit-drill/flights/flight_outcome.hpp"

namespace godwit::drill {

struct known_finding {
  std::string_view in_name; // part of the names of its cases
  std::string_view in_flaw; // part of its sentence
};

[[nodiscard]] std::span<const known_finding> known_findings();

// Moves those of ALL among the flaws of EACH to `known`.
void set_known_aside(flight_outcome& each, std::span<const known_finding> all = known_findings());

} // namespace godwit::drill
