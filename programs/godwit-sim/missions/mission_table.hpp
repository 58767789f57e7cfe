// The missions of the file, and the ids that their items have or had. Errors: kept by the file. Thread: the file's.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <tl/expected.hpp>

#include "actors/domain/mission/error.hpp"
#include "messages/mission/document.hpp"
#include "messages/mission/map_objects.hpp"
#include "programs/godwit-sim/missions/service_file.hpp"

namespace godwit::sim::missions {

struct mission_row {
  std::string mission_id;
  std::int64_t revision = 1;
  std::int64_t last_revision = 1; // that the mission or one of its assignments has
  std::int64_t last_report_no = 0;
  std::int64_t map_epoch = 0;
  std::optional<std::string> deleted_at; // UTC
};

[[nodiscard]] std::optional<mission_row> find_mission(service_file& file, const std::string& mission_id);
// Ids of those that are not deleted.
[[nodiscard]] std::vector<std::string> live_missions(service_file& file);
// The document as it was stored.
[[nodiscard]] std::string mission_text(service_file& file, const std::string& mission_id);
[[nodiscard]] mission::document stored_mission(service_file& file, const std::string& mission_id);

void add_mission(service_file& file, const mission::document& mission);
// The revision is that of MISSION, and the last one that anybody has.
void replace_mission(service_file& file, const mission::document& mission);
void delete_mission(service_file& file, const std::string& mission_id, const std::string& at);
// LAST: the number of its last report.
void set_last_report(service_file& file, const std::string& mission_id, std::int64_t last);

// The mission, or an assignment for it, has or had the item.
[[nodiscard]] bool knows_item(service_file& file, const std::string& mission_id, const std::string& item_id);
// Notes the items of a mission. What comes back is wrong: their ids were those of other items. POINTER: of the items in
// the request; of one alone when IS_LIST is false.
[[nodiscard]] std::vector<mission::document_problem> note_items(service_file& file, const std::string& mission_id,
                                                                std::span<const mission::item> items,
                                                                const std::string& pointer, bool is_list = true);

// A mission with another end, or with one more waypoint: what inserts, tails and assignments make of it.
//
// Errors: none of them changes anything; `missing` is the id that the change goes by and the mission does not have, the
// places are in the list of new items. Thread: pure.
enum class rest_of_items {
  keep,   // what comes after the new items stays
  replace // nothing comes after them
};

struct missing_item {
  std::string id;
};
using change_error = std::variant<missing_item, std::vector<mission::document_problem>>;

// NEW_ITEMS after the item AFTER of OLD (none: in front of all). POINTER: where the new items stand in the request;
// with IS_LIST after an index. The revision is that of OLD.
[[nodiscard]] tl::expected<mission::document, change_error>
changed_mission(const mission::document& old, const std::optional<std::string>& after,
                const std::vector<mission::item>& new_items, rest_of_items rest, const std::string& pointer,
                bool is_list = true);

// What the map has, page by page: the objects and what is ignored, as they were when the first page was asked for.
//
// Rows are only ever added, with rising numbers, so a page that goes no further than the last row of that moment shows
// it. When the objects are replaced, `map_epoch` of the mission rises, and an older `next` is not known any more; what
// has changed gets new numbers, and what was removed keeps a row without a text, for those who have an older mark.
// Errors: kept by the file. Thread: the file's.

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

struct page_made {
  std::string body;
  std::string next; // empty: it is the last one
};
struct page_request {
  std::string next; // empty: the first one
  std::uint64_t limit = 0;
  std::optional<std::string> since; // a mark, of objects; empty: a mark is wanted, and all of the map
};
// None: `next` is not known (any more).
[[nodiscard]] std::optional<page_made> page(service_file& file, const mission_row& of, page_kind kind,
                                            const page_request& asked);

void replace_map_objects(service_file& file, const std::string& mission_id,
                         const std::vector<mission::map_object>& objects);
[[nodiscard]] std::uint64_t map_object_count(service_file& file, const std::string& mission_id);

} // namespace godwit::sim::missions
