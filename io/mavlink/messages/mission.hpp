// The plan and its progress: MISSION_CURRENT, MISSION_ITEM_REACHED, MISSION_SET_CURRENT.
// Source: MAVLink's common.xml, whose names and order of fields are kept.
#pragma once

#include <cstdint>

#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

struct mission_set_current {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint16_t seq = 0;

  static constexpr std::uint32_t message_id = 41;
  static constexpr std::uint8_t crc_extra = 28;
  GODWIT_FIELDS(mission_set_current, "MISSION_SET_CURRENT", target_system, target_component, seq);
};

// The ids are those of the plans that the vehicle holds, 0 for none or if it does not keep any.
struct mission_current {
  std::uint16_t seq = 0;
  std::uint16_t total = 0;        // 0 not told, 65535 no plan
  std::uint8_t mission_state = 0; // mission_state
  std::uint8_t mission_mode = 0;  // 0 unknown, 1 in mission mode, 2 suspended
  std::uint32_t mission_id = 0;
  std::uint32_t fence_id = 0;
  std::uint32_t rally_points_id = 0;

  static constexpr std::uint32_t message_id = 42;
  static constexpr std::uint8_t crc_extra = 28;
  static constexpr std::size_t extensions = 6;
  GODWIT_FIELDS(mission_current, "MISSION_CURRENT", seq, total, mission_state, mission_mode, mission_id, fence_id,
                rally_points_id);
};

struct mission_item_reached {
  std::uint16_t seq = 0;

  static constexpr std::uint32_t message_id = 46;
  static constexpr std::uint8_t crc_extra = 11;
  GODWIT_FIELDS(mission_item_reached, "MISSION_ITEM_REACHED", seq);
};

} // namespace godwit::io::mavlink
