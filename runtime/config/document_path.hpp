// Names of places in a document, as people write them: `trace.total_mib`, `links[2].port`, `a."b c"`.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace godwit::runtime {

// `key` as it is when it is a plain word, else as a JSON text, shortened when it is long.
[[nodiscard]] std::string readable_key(std::string_view key);

[[nodiscard]] std::string path_to_key(std::string_view parent, std::string_view key);
[[nodiscard]] std::string path_to_item(std::string_view parent, std::size_t index);

} // namespace godwit::runtime
