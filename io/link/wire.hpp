// What an actor sees of its link: a place to put frames, and what has come in. A test puts a line of its own in here.
// Thread: any.
#pragma once

#include <cstddef>
#include <span>

#include "io/link/link.hpp"
#include "io/link/rx_queue.hpp"

namespace godwit::io::link {

class wire {
public:
  wire() = default;
  wire(const wire&) = delete;
  wire& operator=(const wire&) = delete;
  virtual ~wire() = default;

  // False: dropped and counted by the link.
  virtual bool send(std::span<const std::byte> frame, peer_id to) = 0;

  [[nodiscard]] rx_queue& incoming() { return incoming_; }

private:
  rx_queue incoming_;
};

} // namespace godwit::io::link
