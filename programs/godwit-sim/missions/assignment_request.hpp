// A new assignment, as a person or a test asks for it.
//
// Errors: a sentence with each wrong place. Thread: pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "messages/mission/item.hpp"

namespace godwit::sim::missions {

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
