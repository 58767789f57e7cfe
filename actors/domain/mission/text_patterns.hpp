// The patterns of config/schemas as functions: std::regex takes microseconds for a UUID, and a page of the map has
// thousands.
//
// Each pattern of the schemas has its function, and its test holds the two against each other. Thread: pure.
#pragma once

#include <string_view>

namespace godwit::mission {

using text_test = bool (*)(std::string_view text);

// Whether a text has the form that PATTERN says. A pattern that is not known is a broken invariant: the schemas are
// part of the program.
[[nodiscard]] text_test test_of_pattern(std::string_view pattern);

} // namespace godwit::mission
