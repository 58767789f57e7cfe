// The assignments of the file, and what became of them. Errors: kept by the file. Thread: the file's.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "messages/mission/change.hpp"
#include "programs/godwit-sim/missions/service_file.hpp"

namespace godwit::sim::missions {

inline constexpr int max_assignments_in_answer = 16; // as in the schema of the list

struct assignment_row {
  mission::assignment what;
  std::optional<mission::assignment_outcome> outcome; // none: no answer yet
};

void add_assignment(service_file& file, const std::string& mission_id, const mission::assignment& what);
// Of that mission.
[[nodiscard]] std::optional<assignment_row> find_assignment(service_file& file, const std::string& mission_id,
                                                            const std::string& assignment_id);
void set_outcome(service_file& file, const std::string& assignment_id, mission::assignment_outcome outcome);

// The body of an answer with those above the revision AFTER that were not rejected, the oldest first; empty: there are
// none.
[[nodiscard]] std::string assignments_after(service_file& file, const std::string& mission_id, std::int64_t after);

} // namespace godwit::sim::missions
