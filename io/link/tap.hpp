// Who hears what goes over a line, beside the actor that uses it: a recording.
//
// It must not block: it is called in the link's own thread (received) and in that of whoever sends (sent). The bytes
// are valid during the call. Thread: any.
#pragma once

#include <cstddef>
#include <span>

#include "io/link/link.hpp"

namespace godwit::io::link {

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
