// Whom a link speaks with, and how it is. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>

#include "io/fields/field_table.hpp"

namespace godwit::io::link {

// Stays the same for one remote address while it is remembered. Serial, TCP, udpout: always 1.
using peer_id = std::uint32_t;
inline constexpr peer_id every_peer = 0;
inline constexpr peer_id only_peer = 1;

enum class link_phase { connecting, up, down };
GODWIT_ENUM_NAMES(link_phase, connecting, up, down);

struct link_status {
  link_phase phase = link_phase::connecting;
  std::string reason;           // a sentence for people: what is tried, where it is up, why it is down
  std::uint64_t reconnects = 0; // times it came up again after the first time
  bool operator==(const link_status&) const = default;
};

} // namespace godwit::io::link
