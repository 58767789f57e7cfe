// RADIO_STATUS. Source: MAVLink's common.xml, whose names and order of fields are kept.
#pragma once

#include <cstdint>

#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

// From a telemetry radio about itself; radios insert it into the stream without a signature.
struct radio_status {
  std::uint8_t rssi = 0;
  std::uint8_t remrssi = 0;
  std::uint8_t txbuf = 0; // % that is free
  std::uint8_t noise = 0;
  std::uint8_t remnoise = 0;
  std::uint16_t rxerrors = 0;
  std::uint16_t fixed = 0;

  static constexpr std::uint32_t message_id = 109;
  static constexpr std::uint8_t crc_extra = 185;
  GODWIT_FIELDS(radio_status, "RADIO_STATUS", rssi, remrssi, txbuf, noise, remnoise, rxerrors, fixed);
};

} // namespace godwit::io::mavlink
