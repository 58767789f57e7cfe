// A frame for a line. Thread: values.
#pragma once

#include "io/link/status.hpp"
#include "io/mavlink/frame.hpp"

namespace godwit::line {

struct transmission {
  io::link::peer_id to = io::link::every_peer;
  io::mavlink::frame_buffer frame;
};

} // namespace godwit::line
