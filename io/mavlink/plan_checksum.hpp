// The id of a plan: a checksum of what it says, so that the same plan has the same id wherever it comes from. Pure.
//
// Source: MISSION_CURRENT.mission_id, which has to change with the plan and is else the vehicle's own choice.
#pragma once

#include <cstdint>
#include <vector>

#include "io/mavlink/messages/mission_transfer.hpp"

namespace godwit::io::mavlink {

// CRC-32 of the items, without what is no part of a plan: address, type, and the mark of the current item. 0 without
// items, and never 0 with some.
[[nodiscard]] std::uint32_t checksum_of(const std::vector<mission_item_int>& items);

} // namespace godwit::io::mavlink
