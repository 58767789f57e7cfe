// Whether a mission may hold a command at all, whoever is to fly it.
//
//   moves, acts, waits, flow    carried
//   guarded, unknown            carried where flight.allowed_commands names the number
//   never                       not carried, whatever is allowed
//   fence, rally                not carried among the items of a mission
//
// Pure. Thread: any.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace godwit::mission {

// Numbers of MAV_CMD, as the setting flight.allowed_commands has them.
using allowed_commands = std::vector<std::uint16_t>;

inline constexpr std::size_t max_allowed_commands = 64;

// Of a number, or of a name in the table such as DO_PARACHUTE. Nothing: there is none.
[[nodiscard]] std::optional<std::uint16_t> command_number(std::string_view text);

// Whatever is allowed.
[[nodiscard]] bool is_never_carried(std::uint16_t command);

// As a sentence without an end; empty: a mission may hold it.
[[nodiscard]] std::string why_not_carried(std::uint16_t command, std::span<const std::uint16_t> allowed);

} // namespace godwit::mission
