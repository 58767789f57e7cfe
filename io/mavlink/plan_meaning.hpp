// Do two plans mean the same to a vehicle?
//
// ArduPilot does not give back what was sent: it keeps its own home as item 0, gives frame 3 for frame 6, rounds the
// altitude to a centimetre, cuts times to whole seconds, and drops parameters that it does not use. So what is compared
// is what moves the vehicle: command, position, the kind of altitude, the speed of DO_CHANGE_SPEED, where a DO_JUMP
// leads and how often, and how long it stays; a time that comes back as 0 counts as dropped. PX4 keeps NAV_ROI as
// DO_SET_ROI and CONDITION_DELAY as NAV_DELAY. Other parameters are not compared. Source: seen on ArduPilot 4.7 and
// PX4 1.17. Thread: pure.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "io/mavlink/messages/mission_transfer.hpp"

namespace godwit::io::mavlink {

// 1e-7 degrees: 10 of them are 0.11 m. A vehicle that keeps floats loses more, and would not be trusted anyway.
inline constexpr std::int32_t position_tolerance = 10;
inline constexpr float altitude_tolerance_m = 0.02F;
inline constexpr float speed_tolerance_mps = 0.05F;
inline constexpr float time_tolerance_s = 1;

[[nodiscard]] bool means_the_same(const mission_item_int& a, const mission_item_int& b);

// The first item in which the two differ; the length of the shorter one if it is the beginning of the other. Nothing:
// they mean the same. FIRST_IS_HOME: item 0 is not compared.
[[nodiscard]] std::optional<std::size_t> first_difference(std::span<const mission_item_int> ours,
                                                          std::span<const mission_item_int> theirs, bool first_is_home);

// The id of a plan: a checksum of what it says, so that the same plan has the same id wherever it comes from. Pure.
//
// Source: MISSION_CURRENT.mission_id, which has to change with the plan and is else the vehicle's own choice.

// CRC-32 of the items, without what is no part of a plan: address, type, and the mark of the current item. 0 without
// items, and never 0 with some.
[[nodiscard]] std::uint32_t checksum_of(const std::vector<mission_item_int>& items);

} // namespace godwit::io::mavlink
