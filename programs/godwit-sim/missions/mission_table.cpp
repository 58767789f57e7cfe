#include "programs/godwit-sim/missions/mission_table.hpp"

#include <utility>

#include <nlohmann/json.hpp>

#include "actors/domain/mission/write.hpp"
#include "io/fields/json_value.hpp"
#include "runtime/assert.hpp"

namespace godwit::sim::missions {

using io::sqlite::statement;

std::optional<mission_row> find_mission(service_file& file, const std::string& mission_id) {
  return file.first_row(
      "SELECT revision, last_revision, last_report_no, map_epoch, deleted_at FROM missions WHERE mission_id = ?1",
      [&](const statement& row) {
        return mission_row{.mission_id = mission_id,
                           .revision = row.integer(0),
                           .last_revision = row.integer(1),
                           .last_report_no = row.integer(2),
                           .map_epoch = row.integer(3),
                           .deleted_at = row.is_null(4) ? std::nullopt : std::optional(row.text(4))};
      },
      mission_id);
}

std::vector<std::string> live_missions(service_file& file) {
  std::vector<std::string> all;
  file.each_row("SELECT mission_id FROM missions WHERE deleted_at IS NULL ORDER BY rowid",
                [&](const statement& row) { all.push_back(row.text(0)); });
  return all;
}

std::string mission_text(service_file& file, const std::string& mission_id) {
  return file
      .first_row(
          "SELECT text FROM missions WHERE mission_id = ?1", [](const statement& row) { return row.text(0); },
          mission_id)
      .value_or(std::string());
}

// What lies in the file was judged before it was put there.
mission::document stored_mission(service_file& file, const std::string& mission_id) {
  mission::document stored;
  const auto text = mission_text(file, mission_id);
  if (file.has_failed())
    return stored;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  GODWIT_ASSERT(io::read_json(json, stored).has_value(), "the mission in the file is one");
  return stored;
}

void add_mission(service_file& file, const mission::document& mission) {
  file.run("INSERT INTO missions(mission_id, revision, last_revision, text) VALUES (?1, ?2, ?2, ?3)",
           mission.mission_id, mission.revision, mission::to_text(mission));
  static_cast<void>(note_items(file, mission.mission_id, mission.items, {})); // there were none before
}

void replace_mission(service_file& file, const mission::document& mission) {
  file.run("UPDATE missions SET revision = ?2, last_revision = MAX(last_revision, ?2), text = ?3 WHERE mission_id = ?1",
           mission.mission_id, mission.revision, mission::to_text(mission));
}

void delete_mission(service_file& file, const std::string& mission_id, const std::string& at) {
  file.run("UPDATE missions SET deleted_at = ?2 WHERE mission_id = ?1 AND deleted_at IS NULL", mission_id, at);
}

void set_last_report(service_file& file, const std::string& mission_id, std::int64_t last) {
  file.run("UPDATE missions SET last_report_no = ?2 WHERE mission_id = ?1", mission_id, last);
}

bool knows_item(service_file& file, const std::string& mission_id, const std::string& item_id) {
  return file.number("SELECT 1 FROM items WHERE mission_id = ?1 AND item_id = ?2", mission_id, item_id).has_value();
}

std::vector<mission::document_problem> note_items(service_file& file, const std::string& mission_id,
                                                  std::span<const mission::item> items, const std::string& pointer,
                                                  bool is_list) {
  std::vector<mission::document_problem> problems;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto& id = mission::id_of(items[i]);
    std::string text;
    append_json_value(text, items[i]);
    const auto is_same =
        file.number("INSERT INTO items(mission_id, item_id, text) VALUES (?1, ?2, ?3) "
                    "ON CONFLICT(mission_id, item_id) DO UPDATE SET text = items.text RETURNING text = ?3",
                    mission_id, id, text);
    if (is_same && *is_same == 0)
      problems.push_back({mission::pointer_to(is_list ? mission::pointer_to(pointer, i) : pointer, "id"),
                          "is " + mission::in_quotes(id) + ", which was the id of another item",
                          "an id that no other item has or had"});
  }
  return problems;
}

} // namespace godwit::sim::missions
