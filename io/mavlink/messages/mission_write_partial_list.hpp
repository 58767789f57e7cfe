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
  static constexpr auto fields =
      table("MISSION_WRITE_PARTIAL_LIST", field("target_system", &mission_write_partial_list::target_system),
            field("target_component", &mission_write_partial_list::target_component),
            field("start_index", &mission_write_partial_list::start_index),
            field("end_index", &mission_write_partial_list::end_index),
            field("mission_type", &mission_write_partial_list::mission_type));
};

} // namespace godwit::io::mavlink
