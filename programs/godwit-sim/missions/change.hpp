// A mission with another end, or with one more waypoint: what inserts, tails and assignments make of it.
//
// Errors: none of them changes anything; `missing` is the id that the change goes by and the mission does not have, the
// places are in the list of new items. Thread: pure.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <tl/expected.hpp>

#include "actors/domain/mission/error.hpp"
#include "messages/mission/document.hpp"

namespace godwit::sim::missions {

enum class behind {
  keep,   // what comes behind the new items stays
  replace // nothing comes behind them
};

struct missing_item {
  std::string id;
};
using change_error = std::variant<missing_item, std::vector<mission::document_problem>>;

// NEW_ITEMS after the item AFTER of OLD (none: in front of all). POINTER: where the new items stand in the request;
// with IS_LIST after an index. The revision is that of OLD.
[[nodiscard]] tl::expected<mission::document, change_error> changed_mission(const mission::document& old,
                                                                            const std::optional<std::string>& after,
                                                                            const std::vector<mission::item>& new_items,
                                                                            behind rest, const std::string& pointer,
                                                                            bool is_list = true);

} // namespace godwit::sim::missions
