// "Did you mean ...?": the known word that is nearest to an unknown one.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace godwit::io::schemas {

// Nothing when no word is near: more than a third of the letters would have to change (two in a short word).
[[nodiscard]] std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& known);

} // namespace godwit::io::schemas
