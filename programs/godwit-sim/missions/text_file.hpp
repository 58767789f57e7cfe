// A whole file as text, within a bound. Errors: a sentence with the name of the file. Thread: any; blocks on the disk.
#pragma once

#include <cstddef>
#include <string>

#include <tl/expected.hpp>

namespace godwit::sim::missions {

[[nodiscard]] tl::expected<std::string, std::string> read_text_file(const std::string& name, std::size_t max_bytes);

} // namespace godwit::sim::missions
