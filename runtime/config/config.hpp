// The configuration of a program: a JSON document with comments, checked against its schema, complete with defaults.
//
//   auto settings = load_config_file("godwit.json", godwit_schema());
//   if (!settings) { print(settings.error().message()); return 2; }
//   const auto workers = settings->at("scheduler").at("workers").get<unsigned>(); // is there, has the right type and
//   range
//
// Thread: any; no shared state.
#pragma once

#include <filesystem>
#include <string_view>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

#include "runtime/config/error.hpp"

namespace godwit::runtime {

// Parses and validates `text`, and fills in the defaults. `source` is for messages. The key "$schema" is for editors
// and is taken out.
[[nodiscard]] tl::expected<nlohmann::json, config_error> load_config(std::string_view text, std::string_view source,
                                                                     std::string_view schema_text);

// The same for a file; reads no more than the bound.
[[nodiscard]] tl::expected<nlohmann::json, config_error> load_config_file(const std::filesystem::path& file,
                                                                          std::string_view schema_text);

// config/godwit.schema.json, as it was when the program was built: programs work without files beside them.
[[nodiscard]] std::string_view godwit_schema();

} // namespace godwit::runtime
