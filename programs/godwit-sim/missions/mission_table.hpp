// The missions of the file, and the ids that their items have or had. Errors: kept by the file. Thread: the file's.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "actors/domain/mission/error.hpp"
#include "messages/mission/document.hpp"
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

} // namespace godwit::sim::missions
