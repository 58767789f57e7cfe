// What a schema of config/schemas says about a document: two judges who know nothing of each other, and our sentences
// with a JSON pointer to each place.
//
// `quick` is schema_check, for rows by the thousand. `both` asks valijson as well, for what a vehicle is to fly: each
// of the two would have let something through that the other refuses.
//
// Sentences cover the keywords that config/schemas uses: type, enum, const, ranges, lengths, pattern, required, unknown
// properties, numbers of items, and allOf with if and then. Thread: any.
#pragma once

#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "actors/domain/mission/error.hpp"

namespace godwit::mission {

enum class judges { quick, both };

// What is wrong with DOCUMENT by the schema of that name; empty when it is valid.
[[nodiscard]] std::vector<document_problem> violations(const nlohmann::json& document, std::string_view schema_name,
                                                       judges asked);

// What valijson alone says.
[[nodiscard]] bool is_valid_for_valijson(const nlohmann::json& document, std::string_view schema_name);

} // namespace godwit::mission
