#include "programs/godwit-sim/missions/assignment_request.hpp"

#include <nlohmann/json.hpp>

#include "actors/domain/mission/json_document.hpp"
#include "actors/domain/mission/read.hpp"
#include "messages/mission/change.hpp"

namespace godwit::sim::missions {

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
