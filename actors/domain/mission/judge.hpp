// What a schema of config/schemas says about a document, with a JSON pointer to each place.
//
// valijson judges (io/json_schema). It takes 4 us and more for each row of a list, so rows by the thousand are judged
// by schema_check, which a test holds against valijson (docs/decisions/map-and-service.md). The sentences are the same.
// Thread: any.
#pragma once

#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "actors/domain/mission/error.hpp"

namespace godwit::mission {

enum class judge { valijson, for_rows };

// What is wrong with DOCUMENT by the schema of that name; empty when it is valid.
[[nodiscard]] std::vector<document_problem> violations(const nlohmann::json& document, std::string_view schema_name,
                                                       judge by);

} // namespace godwit::mission
