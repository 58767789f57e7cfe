// What the actor sees of its link: a place to put frames, and what has come in. A test puts a line of its own in here.
// Thread: any.
#pragma once

#include <cstddef>
#include <span>

#include "actors/vehicle_link/arrivals.hpp"
#include "io/link/link.hpp"

namespace godwit::vehicle_link {

class wire {
public:
  wire() = default;
  wire(const wire&) = delete;
  wire& operator=(const wire&) = delete;
  virtual ~wire() = default;

  // False: dropped and counted by the link.
  virtual bool send(std::span<const std::byte> frame, io::link::peer_id to) = 0;

  [[nodiscard]] arrivals& incoming() { return incoming_; }

private:
  arrivals incoming_;
};

} // namespace godwit::vehicle_link
