// The ids of items that an operator's change puts in front of what is left of a mission: a number follows. Pure.
#pragma once

#include <string_view>

namespace godwit::executor {

inline constexpr std::string_view go_to_id = "goto";
inline constexpr std::string_view way_back_id = "back";

[[nodiscard]] inline bool is_of_change(std::string_view id) {
  return id.starts_with(go_to_id) || id.starts_with(way_back_id);
}

} // namespace godwit::executor
