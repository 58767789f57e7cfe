// MISSION_WRITE_PARTIAL_LIST: some items of a plan are replaced. Few vehicles do it; the mission server answers it, and
// nobody else reads it, so it is not in the list of messages that are read everywhere.
// Source: MAVLink's common.xml, whose names and order of fields are kept.
#pragma once

#include <cstdint>

#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

struct mission_write_partial_list {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::int16_t start_index = 0; // the first and the last item that will come
  std::int16_t end_index = 0;
  std::uint8_t mission_type = 0;

  static constexpr std::uint32_t message_id = 38;
  static constexpr std::uint8_t crc_extra = 9;
  static constexpr std::size_t extensions = 1;
  GODWIT_FIELDS(mission_write_partial_list, "MISSION_WRITE_PARTIAL_LIST", target_system, target_component, start_index,
                end_index, mission_type);
};

} // namespace godwit::io::mavlink
