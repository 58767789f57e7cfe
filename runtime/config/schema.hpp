// What a JSON Schema (draft-07) says about a configuration: what is wrong with it, with places as people write them in
// a configuration, and what absent keys mean.
//
// io/json_schema judges and has the sentences. Thread: any; no shared state.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
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

// Names of places in a document, as people write them: `trace.total_mib`, `links[2].port`, `a."b c"`.

// `key` as it is when it is a plain word, else as a JSON text, shortened when it is long.
[[nodiscard]] std::string readable_key(std::string_view key);

[[nodiscard]] std::string path_to_key(std::string_view parent, std::string_view key);
[[nodiscard]] std::string path_to_item(std::string_view parent, std::size_t index);

} // namespace godwit::runtime
