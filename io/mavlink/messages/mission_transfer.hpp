// The transfer of a plan, its fence and its rally points, in both directions.
// MISSION_ITEM and MISSION_REQUEST are the deprecated forms with float coordinates; some peers still ask with the
// second. Source: MAVLink's common.xml, whose names and order of fields are kept.
#pragma once

#include <cstdint>

#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

struct mission_item {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint16_t seq = 0;
  std::uint8_t frame = 0;    // mav_frame
  std::uint16_t command = 0; // mav_cmd
  std::uint8_t current = 0;
  std::uint8_t autocontinue = 0;
  float param1 = 0;
  float param2 = 0;
  float param3 = 0;
  float param4 = 0;
  float x = 0;
  float y = 0;
  float z = 0; // m
  std::uint8_t mission_type = 0;

  static constexpr std::uint32_t message_id = 39;
  static constexpr std::uint8_t crc_extra = 254;
  static constexpr std::size_t extensions = 1;
  GODWIT_FIELDS(mission_item, "MISSION_ITEM", target_system, target_component, seq, frame, command, current,
                autocontinue, param1, param2, param3, param4, x, y, z, mission_type);
};

struct mission_request {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint16_t seq = 0;
  std::uint8_t mission_type = 0;

  static constexpr std::uint32_t message_id = 40;
  static constexpr std::uint8_t crc_extra = 230;
  static constexpr std::size_t extensions = 1;
  GODWIT_FIELDS(mission_request, "MISSION_REQUEST", target_system, target_component, seq, mission_type);
};

struct mission_request_list {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint8_t mission_type = 0;

  static constexpr std::uint32_t message_id = 43;
  static constexpr std::uint8_t crc_extra = 132;
  static constexpr std::size_t extensions = 1;
  GODWIT_FIELDS(mission_request_list, "MISSION_REQUEST_LIST", target_system, target_component, mission_type);
};

struct mission_count {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint16_t count = 0;
  std::uint8_t mission_type = 0;
  std::uint32_t opaque_id = 0; // the id of the plan on the vehicle, in a download

  static constexpr std::uint32_t message_id = 44;
  static constexpr std::uint8_t crc_extra = 221;
  static constexpr std::size_t extensions = 2;
  GODWIT_FIELDS(mission_count, "MISSION_COUNT", target_system, target_component, count, mission_type, opaque_id);
};

struct mission_clear_all {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint8_t mission_type = 0;

  static constexpr std::uint32_t message_id = 45;
  static constexpr std::uint8_t crc_extra = 232;
  static constexpr std::size_t extensions = 1;
  GODWIT_FIELDS(mission_clear_all, "MISSION_CLEAR_ALL", target_system, target_component, mission_type);
};

struct mission_ack {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint8_t type = 0; // mav_mission_result
  std::uint8_t mission_type = 0;
  std::uint32_t opaque_id = 0; // the id of the plan as uploaded, 0 if not kept

  static constexpr std::uint32_t message_id = 47;
  static constexpr std::uint8_t crc_extra = 153;
  static constexpr std::size_t extensions = 2;
  GODWIT_FIELDS(mission_ack, "MISSION_ACK", target_system, target_component, type, mission_type, opaque_id);
};

struct mission_request_int {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint16_t seq = 0;
  std::uint8_t mission_type = 0;

  static constexpr std::uint32_t message_id = 51;
  static constexpr std::uint8_t crc_extra = 196;
  static constexpr std::size_t extensions = 1;
  GODWIT_FIELDS(mission_request_int, "MISSION_REQUEST_INT", target_system, target_component, seq, mission_type);
};

struct mission_item_int {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint16_t seq = 0;
  std::uint8_t frame = 0;    // mav_frame
  std::uint16_t command = 0; // mav_cmd
  std::uint8_t current = 0;
  std::uint8_t autocontinue = 0;
  float param1 = 0;
  float param2 = 0;
  float param3 = 0;
  float param4 = 0;
  std::int32_t x = 0; // degrees times 1e7 in the global frames
  std::int32_t y = 0;
  float z = 0; // m
  std::uint8_t mission_type = 0;

  static constexpr std::uint32_t message_id = 73;
  static constexpr std::uint8_t crc_extra = 38;
  static constexpr std::size_t extensions = 1;
  GODWIT_FIELDS(mission_item_int, "MISSION_ITEM_INT", target_system, target_component, seq, frame, command, current,
                autocontinue, param1, param2, param3, param4, x, y, z, mission_type);
};

// MISSION_WRITE_PARTIAL_LIST: some items of a plan are replaced. Few vehicles do it; the mission server answers it, and
// nobody else reads it, so it is not in the list of messages that are read everywhere.
// Source: MAVLink's common.xml, whose names and order of fields are kept.
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
