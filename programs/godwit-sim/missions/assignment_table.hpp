// The assignments of the file, and what became of them. Errors: kept by the file. Thread: the file's.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "messages/mission/change.hpp"
#include "messages/mission/item.hpp"
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

// A new assignment, as a person or a test asks for it.
//
// Errors: a sentence with each wrong place. Thread: pure.

// What is left out is filled in: the id, the mission's own revision, and the next one that nobody has.
struct assignment_request {
  std::vector<mission::item> items;
  std::optional<std::string> replace_after_item_id; // none: all items are replaced
  std::optional<std::string> assignment_id;
  std::optional<std::int32_t> base_revision; // another one than the mission's: stale, the vehicle must reject it
  std::optional<std::int32_t> revision;      // above all that there were
};

// As JSON: an assignment in the form of config/schemas, of which all but the items may be left out.
[[nodiscard]] tl::expected<assignment_request, std::string> parse_assignment_request(std::string_view text);

} // namespace godwit::sim::missions
