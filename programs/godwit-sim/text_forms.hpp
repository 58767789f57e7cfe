// Values as people write them on a command line. Errors: none for what is not of the form; the caller says which form
// that is. Thread: pure.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "io/text.hpp"

namespace godwit::sim {

using io::trimmed;

// All of TEXT, finite.
[[nodiscard]] std::optional<double> read_number(std::string_view text);
[[nodiscard]] std::optional<std::uint64_t> read_whole_number(std::string_view text);

// 15ms, 1.5s, 2min; not negative, at most a year.
[[nodiscard]] std::optional<std::chrono::nanoseconds> read_duration(std::string_view text);

// The shortest text that reads back as the same value.
[[nodiscard]] std::string shortest(double value);

// The parts between the separators, without spaces around them; of an empty text one empty part.
[[nodiscard]] std::vector<std::string_view> parts_of(std::string_view text, char separator);

// Somebody else's text in a sentence of ours: in quotes, printable, cut off.
[[nodiscard]] std::string in_quotes(std::string_view text);

} // namespace godwit::sim

namespace godwit::sim::missions {

// A whole file as text, within a bound. Errors: a sentence with the name of the file. Thread: any; blocks on the disk.
[[nodiscard]] tl::expected<std::string, std::string> read_text_file(const std::string& name, std::size_t max_bytes);

} // namespace godwit::sim::missions
