// A command as text: for the audit, and to tell a repetition from another command under the same id. Pure.
// Thread: any.
#pragma once

#include <string>
#include <string_view>

#include "messages/operator/types.hpp"

namespace godwit::operator_bridge {

// For people: "go_to 47.398000,8.546000,40.0", "acknowledge 3".
[[nodiscard]] std::string words_of(const operators::command& what);
// All of it, but for who says it.
[[nodiscard]] std::string text_of(operators::command what);
// 1 to max_command_id letters, digits and -._:~
[[nodiscard]] bool is_command_id(std::string_view id);

} // namespace godwit::operator_bridge
