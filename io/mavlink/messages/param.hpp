// Parameters of the autopilot: PARAM_REQUEST_READ, PARAM_REQUEST_LIST, PARAM_VALUE, PARAM_SET.
// A name fills all 16 characters or ends with a NUL. Values travel as floats: ArduPilot converts the number, PX4 puts
// the bits of an integer into it. Source: MAVLink's common.xml, whose names and order of fields are kept.
#pragma once

#include <array>
#include <cstdint>

#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

struct param_request_read {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::array<char, 16> param_id{};
  std::int16_t param_index = 0; // -1: by name

  static constexpr std::uint32_t message_id = 20;
  static constexpr std::uint8_t crc_extra = 214;
  GODWIT_FIELDS(param_request_read, "PARAM_REQUEST_READ", target_system, target_component, param_id, param_index);
};

struct param_request_list {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;

  static constexpr std::uint32_t message_id = 21;
  static constexpr std::uint8_t crc_extra = 159;
  GODWIT_FIELDS(param_request_list, "PARAM_REQUEST_LIST", target_system, target_component);
};

struct param_value {
  std::array<char, 16> param_id{};
  float param_value = 0;
  std::uint8_t param_type = 0;
  std::uint16_t param_count = 0;
  std::uint16_t param_index = 0;

  static constexpr std::uint32_t message_id = 22;
  static constexpr std::uint8_t crc_extra = 220;
  GODWIT_FIELDS(param_value, "PARAM_VALUE", param_id, param_value, param_type, param_count, param_index);
};

struct param_set {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::array<char, 16> param_id{};
  float param_value = 0;
  std::uint8_t param_type = 0;

  static constexpr std::uint32_t message_id = 23;
  static constexpr std::uint8_t crc_extra = 168;
  GODWIT_FIELDS(param_set, "PARAM_SET", target_system, target_component, param_id, param_value, param_type);
};

} // namespace godwit::io::mavlink
