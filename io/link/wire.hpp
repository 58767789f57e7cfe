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

// Who hears what goes over a line, beside the actor that uses it: a recording.
//
// It must not block: it is called in the link's own thread (received) and in that of whoever sends (sent). The bytes
// are valid during the call. Thread: any.
class tap {
public:
  tap() = default;
  tap(const tap&) = delete;
  tap& operator=(const tap&) = delete;
  virtual ~tap() = default;

  virtual void received(peer_id from, std::span<const std::byte> bytes, bool is_datagram) = 0;
  // The link has taken it; once, to however many peers it goes.
  virtual void sent(std::span<const std::byte> frame) = 0;
};

} // namespace godwit::io::link
