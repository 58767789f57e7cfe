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
  static constexpr auto fields = table(
      "MISSION_ITEM", field("target_system", &mission_item::target_system),
      field("target_component", &mission_item::target_component), field("seq", &mission_item::seq),
      field("frame", &mission_item::frame), field("command", &mission_item::command),
      field("current", &mission_item::current), field("autocontinue", &mission_item::autocontinue),
      field("param1", &mission_item::param1), field("param2", &mission_item::param2),
      field("param3", &mission_item::param3), field("param4", &mission_item::param4), field("x", &mission_item::x),
      field("y", &mission_item::y), field("z", &mission_item::z), field("mission_type", &mission_item::mission_type));
};

struct mission_request {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint16_t seq = 0;
  std::uint8_t mission_type = 0;

  static constexpr std::uint32_t message_id = 40;
  static constexpr std::uint8_t crc_extra = 230;
  static constexpr std::size_t extensions = 1;
  static constexpr auto fields =
      table("MISSION_REQUEST", field("target_system", &mission_request::target_system),
            field("target_component", &mission_request::target_component), field("seq", &mission_request::seq),
            field("mission_type", &mission_request::mission_type));
};

struct mission_request_list {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint8_t mission_type = 0;

  static constexpr std::uint32_t message_id = 43;
  static constexpr std::uint8_t crc_extra = 132;
  static constexpr std::size_t extensions = 1;
  static constexpr auto fields =
      table("MISSION_REQUEST_LIST", field("target_system", &mission_request_list::target_system),
            field("target_component", &mission_request_list::target_component),
            field("mission_type", &mission_request_list::mission_type));
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
  static constexpr auto fields =
      table("MISSION_COUNT", field("target_system", &mission_count::target_system),
            field("target_component", &mission_count::target_component), field("count", &mission_count::count),
            field("mission_type", &mission_count::mission_type), field("opaque_id", &mission_count::opaque_id));
};

struct mission_clear_all {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint8_t mission_type = 0;

  static constexpr std::uint32_t message_id = 45;
  static constexpr std::uint8_t crc_extra = 232;
  static constexpr std::size_t extensions = 1;
  static constexpr auto fields = table("MISSION_CLEAR_ALL", field("target_system", &mission_clear_all::target_system),
                                       field("target_component", &mission_clear_all::target_component),
                                       field("mission_type", &mission_clear_all::mission_type));
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
  static constexpr auto fields =
      table("MISSION_ACK", field("target_system", &mission_ack::target_system),
            field("target_component", &mission_ack::target_component), field("type", &mission_ack::type),
            field("mission_type", &mission_ack::mission_type), field("opaque_id", &mission_ack::opaque_id));
};

struct mission_request_int {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint16_t seq = 0;
  std::uint8_t mission_type = 0;

  static constexpr std::uint32_t message_id = 51;
  static constexpr std::uint8_t crc_extra = 196;
  static constexpr std::size_t extensions = 1;
  static constexpr auto fields =
      table("MISSION_REQUEST_INT", field("target_system", &mission_request_int::target_system),
            field("target_component", &mission_request_int::target_component), field("seq", &mission_request_int::seq),
            field("mission_type", &mission_request_int::mission_type));
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
  static constexpr auto fields =
      table("MISSION_ITEM_INT", field("target_system", &mission_item_int::target_system),
            field("target_component", &mission_item_int::target_component), field("seq", &mission_item_int::seq),
            field("frame", &mission_item_int::frame), field("command", &mission_item_int::command),
            field("current", &mission_item_int::current), field("autocontinue", &mission_item_int::autocontinue),
            field("param1", &mission_item_int::param1), field("param2", &mission_item_int::param2),
            field("param3", &mission_item_int::param3), field("param4", &mission_item_int::param4),
            field("x", &mission_item_int::x), field("y", &mission_item_int::y), field("z", &mission_item_int::z),
            field("mission_type", &mission_item_int::mission_type));
};

} // namespace godwit::io::mavlink
