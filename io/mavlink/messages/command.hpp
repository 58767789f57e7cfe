// Orders and their answers: COMMAND_INT, COMMAND_LONG, COMMAND_ACK, COMMAND_CANCEL, SET_MODE.
// Source: MAVLink's common.xml, whose names and order of fields are kept.
#pragma once

#include <cstdint>

#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

struct set_mode {
  std::uint8_t target_system = 0;
  std::uint8_t base_mode = 0;
  std::uint32_t custom_mode = 0;

  static constexpr std::uint32_t message_id = 11;
  static constexpr std::uint8_t crc_extra = 89;
  GODWIT_FIELDS(set_mode, "SET_MODE", target_system, base_mode, custom_mode);
};

// For commands with a position: a float would round latitude and longitude to about a metre.
struct command_int {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
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

  static constexpr std::uint32_t message_id = 75;
  static constexpr std::uint8_t crc_extra = 158;
  GODWIT_FIELDS(command_int, "COMMAND_INT", target_system, target_component, frame, command, current, autocontinue,
                param1, param2, param3, param4, x, y, z);
};

struct command_long {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint16_t command = 0;     // mav_cmd
  std::uint8_t confirmation = 0; // 0 first, then counted up with each repetition
  float param1 = 0;
  float param2 = 0;
  float param3 = 0;
  float param4 = 0;
  float param5 = 0;
  float param6 = 0;
  float param7 = 0;

  static constexpr std::uint32_t message_id = 76;
  static constexpr std::uint8_t crc_extra = 152;
  GODWIT_FIELDS(command_long, "COMMAND_LONG", target_system, target_component, command, confirmation, param1, param2,
                param3, param4, param5, param6, param7);
};

// The target is 0/0 from senders that do not know it.
struct command_ack {
  std::uint16_t command = 0; // mav_cmd
  std::uint8_t result = 0;   // mav_result
  std::uint8_t progress = 0; // %, 255 unknown; with in_progress
  std::int32_t result_param2 = 0;
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;

  static constexpr std::uint32_t message_id = 77;
  static constexpr std::uint8_t crc_extra = 143;
  static constexpr std::size_t extensions = 4;
  GODWIT_FIELDS(command_ack, "COMMAND_ACK", command, result, progress, result_param2, target_system, target_component);
};

struct command_cancel {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint16_t command = 0; // mav_cmd

  static constexpr std::uint32_t message_id = 80;
  static constexpr std::uint8_t crc_extra = 14;
  GODWIT_FIELDS(command_cancel, "COMMAND_CANCEL", target_system, target_component, command);
};

} // namespace godwit::io::mavlink
