// REQUEST_DATA_STREAM: the older way to ask for a group of messages, for vehicles that do not know
// SET_MESSAGE_INTERVAL. It is only ever sent by us, so it is not in the list of messages that are read.
// Source: MAVLink's common.xml, whose names and order of fields are kept.
#pragma once

#include <cstdint>

#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

struct request_data_stream {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint8_t req_stream_id = 0;     // MAV_DATA_STREAM
  std::uint16_t req_message_rate = 0; // Hz
  std::uint8_t start_stop = 0;        // 1: send, 0: stop

  static constexpr std::uint32_t message_id = 66;
  static constexpr std::uint8_t crc_extra = 148;
  GODWIT_FIELDS(request_data_stream, "REQUEST_DATA_STREAM", target_system, target_component, req_stream_id,
                req_message_rate, start_stop);
};

} // namespace godwit::io::mavlink
