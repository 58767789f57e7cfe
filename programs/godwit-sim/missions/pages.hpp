// What the map has, page by page: the objects and what is ignored, as they were when the first page was asked for.
//
// Rows are only ever added, with rising numbers, so a page that goes no further than the last row of that moment shows
// it. When the objects are replaced, `map_epoch` of the mission rises, and an older `next` is not known any more.
// Errors: kept by the file. Thread: the file's.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "messages/mission/map_objects.hpp"
#include "programs/godwit-sim/missions/mission_table.hpp"
#include "programs/godwit-sim/missions/service_file.hpp"

namespace godwit::sim::missions {

// Where a page begins; its text is the `next` of the contract.
struct page_place {
  std::int64_t epoch = 0; // of the mission's objects
  std::int64_t after = 0; // this row
  std::int64_t last = 0;  // row of the whole
  friend bool operator==(const page_place&, const page_place&) = default;
};
[[nodiscard]] std::string text_of(const page_place& place);
[[nodiscard]] std::optional<page_place> parse_page_place(std::string_view text);

enum class page_kind { map_objects, ignored_items };

// The body of an answer. None: NEXT is not known (any more).
[[nodiscard]] std::optional<std::string> page(service_file& file, const mission_row& of, page_kind kind,
                                              const std::string& next, std::uint64_t limit);

void replace_map_objects(service_file& file, const std::string& mission_id,
                         const std::vector<mission::map_object>& objects);
[[nodiscard]] std::uint64_t map_object_count(service_file& file, const std::string& mission_id);

} // namespace godwit::sim::missions
