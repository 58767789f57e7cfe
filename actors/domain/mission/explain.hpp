// The sentences about a document that its schema forbids; see judge.hpp. Thread: pure.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "actors/domain/mission/error.hpp"

namespace godwit::mission {

// Looks no further than one problem beyond max_document_problems.
[[nodiscard]] std::vector<document_problem> explain(const nlohmann::json& document, const nlohmann::json& schema);

// What may stand where SCHEMA holds: "a number from -90 to 90".
[[nodiscard]] std::string allowed_by(const nlohmann::json& schema);

} // namespace godwit::mission
