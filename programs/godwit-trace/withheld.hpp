// Messages that godwit does not decode and whose bytes are shown to nobody, because they hold a password or a key.
//
// SETUP_SIGNING is not here: it is decoded, and its table marks the key as a secret. Source: MAVLink's common.xml.
// Thread: constants.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace godwit::trace_tool {

inline constexpr std::array<std::uint32_t, 4> withheld_ids{
    5,   // CHANGE_OPERATOR_CONTROL: the password of a ground station
    7,   // AUTH_KEY
    299, // WIFI_CONFIG_AP: the password of a network
    336, // CELLULAR_CONFIG: PIN and password of a modem
};

[[nodiscard]] constexpr bool is_withheld(std::uint32_t id) {
  return std::ranges::find(withheld_ids, id) != withheld_ids.end();
}

} // namespace godwit::trace_tool
