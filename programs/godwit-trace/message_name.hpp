// The name of a message by its id, also of those that godwit does not decode; and the id by a name that somebody typed.
//
// Ids that are in no table are called UNKNOWN_<id>. Thread: pure.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace godwit::trace_tool {

inline constexpr std::string_view unknown_prefix = "UNKNOWN_";

void append_message_name(std::string& out, std::uint32_t id);
[[nodiscard]] std::string message_name(std::uint32_t id);

// The name in the table that is most like TEXT (capitals): one that contains it, else that of the fewest changed
// letters.
[[nodiscard]] std::string_view nearest_message_name(std::string_view text);

} // namespace godwit::trace_tool
