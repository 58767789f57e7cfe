#include "programs/godwit-sim/missions/assignment_table.hpp"

#include <nlohmann/json.hpp>

#include "actors/domain/mission/json_document.hpp"
#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/write.hpp"
#include "io/fields/json_value.hpp"
#include "messages/mission/change.hpp"
#include "runtime/assert.hpp"

namespace godwit::sim::missions {

using io::sqlite::statement;

void add_assignment(service_file& file, const std::string& mission_id, const mission::assignment& what) {
  file.run("INSERT INTO assignments(assignment_id, mission_id, revision, text) VALUES (?1, ?2, ?3, ?4)",
           what.assignment_id, mission_id, what.revision, mission::to_text(what));
  file.run("UPDATE missions SET last_revision = ?2 WHERE mission_id = ?1", mission_id, what.revision);
}

std::optional<assignment_row> find_assignment(service_file& file, const std::string& mission_id,
                                              const std::string& assignment_id) {
  return file.first_row(
      "SELECT text, outcome FROM assignments WHERE mission_id = ?1 AND assignment_id = ?2",
      [](const statement& row) {
        assignment_row found;
        const auto json = nlohmann::json::parse(row.text(0), nullptr, false);
        GODWIT_ASSERT(io::read_json(json, found.what).has_value(), "the assignment in the file is one");
        if (!row.is_null(1))
          found.outcome = io::value_of<mission::assignment_outcome>(row.text(1));
        return found;
      },
      mission_id, assignment_id);
}

void set_outcome(service_file& file, const std::string& assignment_id, mission::assignment_outcome outcome) {
  file.run("UPDATE assignments SET outcome = ?2 WHERE assignment_id = ?1", assignment_id, io::name_of(outcome));
}

std::string assignments_after(service_file& file, const std::string& mission_id, std::int64_t after) {
  std::string list;
  file.each_row(
      "SELECT text FROM assignments WHERE mission_id = ?1 AND revision > ?2 AND outcome IS NOT 'rejected' "
      "ORDER BY revision LIMIT ?3",
      [&](const statement& row) { list.append(list.empty() ? "" : ",").append(row.text(0)); }, mission_id, after,
      max_assignments_in_answer);
  return list.empty() ? list : R"({"assignments":[)" + list + "]}";
}

// What is left out is put in as something that keeps the schema, so that the schema can judge the whole.
tl::expected<assignment_request, std::string> parse_assignment_request(std::string_view text) {
  auto document = mission::parse_document(text, mission::max_mission_bytes);
  if (!document)
    return tl::unexpected(document.error().message());
  const auto given = *document;
  if (given.is_object()) {
    document->emplace("assignment_id", "00000000-0000-4000-8000-000000000000");
    document->emplace("base_revision", 1);
    const auto base = given.value("base_revision", nlohmann::json(1));
    document->emplace("revision", base.is_number_integer() ? base.get<std::int64_t>() + 1 : 2);
  }
  auto whole = mission::read<mission::assignment>(document->dump());
  if (!whole)
    return tl::unexpected(whole.error().message());
  assignment_request wanted{.items = std::move(whole->items),
                            .replace_after_item_id = std::move(whole->replace_after_item_id),
                            .assignment_id = {},
                            .base_revision = {},
                            .revision = {}};
  if (given.contains("assignment_id"))
    wanted.assignment_id = std::move(whole->assignment_id);
  if (given.contains("base_revision"))
    wanted.base_revision = whole->base_revision;
  if (given.contains("revision"))
    wanted.revision = whole->revision;
  return wanted;
}

} // namespace godwit::sim::missions
