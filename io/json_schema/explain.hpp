// The sentences about a document that its schema forbids, for people who have to mend it.
//
// Covers type, enum, const, ranges, lengths, pattern, required and unknown properties, numbers of items, and allOf with
// if and then; a `title` stands for all that a schema allows. Of other keywords it says nothing. Thread: pure.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "io/json_schema/problem.hpp"

namespace godwit::io::schemas {

// SCHEMA has no $ref. Looks no further than one problem beyond AT_MOST.
[[nodiscard]] std::vector<problem> explain(const nlohmann::json& document, const nlohmann::json& schema,
                                           std::size_t at_most);

// What may stand where SCHEMA holds: "a number from -90 to 90".
[[nodiscard]] std::string allowed_by(const nlohmann::json& schema);

} // namespace godwit::io::schemas
