// What a JSON Schema (draft-07) says about a document: what is wrong with it, and what absent keys mean.
//
// valijson judges; the sentences are ours, written from the part of the schema that concerns the place. Schemas are
// part of the program: a schema that is broken is a broken invariant, not an error. Sentences cover type, enum, const,
// minimum, maximum, pattern, length, required and unknown keys; other keywords are judged all the same and described in
// valijson's words. `$ref` is judged, but neither described nor searched for defaults: write schemas without it.
// Thread: any; no shared state.
#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "runtime/config/error.hpp"

namespace godwit::runtime {

// Everything that is wrong with `document`, in the order of the schema; empty when it is valid.
[[nodiscard]] std::vector<config_problem> violations(const nlohmann::json& document, const nlohmann::json& schema);

// What may stand where `schema` holds: "an integer from 16 to 65536".
[[nodiscard]] std::string allowed_by(const nlohmann::json& schema);

// Puts the schema's defaults where `document` has no value, also in objects that are absent altogether.
void fill_defaults(nlohmann::json& document, const nlohmann::json& schema);

} // namespace godwit::runtime
