// What a JSON Schema (draft-07) says about a configuration: what is wrong with it, with places as people write them in
// a configuration, and what absent keys mean.
//
// io/json_schema judges and has the sentences. Thread: any; no shared state.
#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "io/json_schema/compiled_schema.hpp"
#include "runtime/config/error.hpp"

namespace godwit::runtime {

// Everything that is wrong with `document`; empty when it is valid.
[[nodiscard]] std::vector<config_problem> violations(const nlohmann::json& document,
                                                     const io::schemas::compiled_schema& schema);

// Puts the schema's defaults where `document` has no value, also in objects that are absent altogether.
void fill_defaults(nlohmann::json& document, const nlohmann::json& schema);

} // namespace godwit::runtime
