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
  static constexpr auto fields =
      table("SET_MODE", field("target_system", &set_mode::target_system), field("base_mode", &set_mode::base_mode),
            field("custom_mode", &set_mode::custom_mode));
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
  static constexpr auto fields =
      table("COMMAND_INT", field("target_system", &command_int::target_system),
            field("target_component", &command_int::target_component), field("frame", &command_int::frame),
            field("command", &command_int::command), field("current", &command_int::current),
            field("autocontinue", &command_int::autocontinue), field("param1", &command_int::param1),
            field("param2", &command_int::param2), field("param3", &command_int::param3),
            field("param4", &command_int::param4), field("x", &command_int::x), field("y", &command_int::y),
            field("z", &command_int::z));
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
  static constexpr auto fields =
      table("COMMAND_LONG", field("target_system", &command_long::target_system),
            field("target_component", &command_long::target_component), field("command", &command_long::command),
            field("confirmation", &command_long::confirmation), field("param1", &command_long::param1),
            field("param2", &command_long::param2), field("param3", &command_long::param3),
            field("param4", &command_long::param4), field("param5", &command_long::param5),
            field("param6", &command_long::param6), field("param7", &command_long::param7));
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
  static constexpr auto fields = table(
      "COMMAND_ACK", field("command", &command_ack::command), field("result", &command_ack::result),
      field("progress", &command_ack::progress), field("result_param2", &command_ack::result_param2),
      field("target_system", &command_ack::target_system), field("target_component", &command_ack::target_component));
};

struct command_cancel {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint16_t command = 0; // mav_cmd

  static constexpr std::uint32_t message_id = 80;
  static constexpr std::uint8_t crc_extra = 14;
  static constexpr auto fields =
      table("COMMAND_CANCEL", field("target_system", &command_cancel::target_system),
            field("target_component", &command_cancel::target_component), field("command", &command_cancel::command));
};

} // namespace godwit::io::mavlink
