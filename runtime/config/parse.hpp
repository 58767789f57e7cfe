// JSON with comments (// and /* */) to a document.
//
// Stricter than the parser underneath: a key that stands twice in an object is a problem, and nesting and texts are
// bounded. Thread: any; no shared state.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

#include "runtime/config/error.hpp"

namespace godwit::runtime {

inline constexpr std::size_t max_config_bytes = 256 * 1024; // a complete configuration has about 4 KiB
inline constexpr std::size_t max_config_depth = 16;         // the schema goes 3 deep; validation recurses once a level
inline constexpr std::size_t max_config_text = 4096;        // a path of Linux; std::regex recurses once a character
inline constexpr std::size_t max_config_problems = 64;      // more than anyone reads at once

// `source` is for messages only: a file name, or a word for where the text came from.
[[nodiscard]] tl::expected<nlohmann::json, config_error> parse_config(std::string_view text, std::string_view source);

} // namespace godwit::runtime
