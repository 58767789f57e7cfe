// What a ground station sent, read from a text (tests/data/stations): a line for each frame.
//
//   12.345678 > COMMAND_LONG target_system=1 command=400 param1=1     by the station, 12.3 s after the first frame
//   12.345900 < COMMAND_ACK command=400 target_system=255             by the vehicle
//   20.000000 > MANUAL_CONTROL payload=00000000f4010000000001         a message that godwit has no fields of
//
// A field that is not there is 0. Lines that begin with # say whose it is. Errors: a line that is none of this ends the
// test with its number. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/mavlink/frame.hpp"

namespace station_recording {

inline constexpr godwit::io::mavlink::sender station_id{255, 190};
inline constexpr godwit::io::mavlink::sender vehicle_id{1, 1};

struct recorded_frame {
  std::int64_t at_ns = 0;
  bool is_stations = true;
  godwit::io::mavlink::frame_buffer frame;
};

[[nodiscard]] std::vector<recorded_frame> read(const std::string& file);

} // namespace station_recording
