// The schemas of config/schemas, as they were when the program was built, with every $ref replaced by what it means.
//
// So whoever judges a document, or explains what is wrong with it, never meets a $ref. The schemas are part of the
// program: one that is missing or broken is a broken invariant. They are read once and then only looked at. Thread:
// any.
#pragma once

#include <span>
#include <string_view>

#include <nlohmann/json.hpp>

namespace godwit::mission {

struct embedded_schema {
  std::string_view name; // "mission": config/schemas/mission.schema.json
  std::string_view text;
};

[[nodiscard]] std::span<const embedded_schema> embedded_schemas();

[[nodiscard]] const nlohmann::json& schema_named(std::string_view name);

} // namespace godwit::mission
