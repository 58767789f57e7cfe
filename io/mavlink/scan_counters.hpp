// What a scanner has seen, by cause and by kind of message. Counters only grow. Thread: a value.
#pragma once

#include <array>
#include <cstdint>

#include "io/mavlink/ids.hpp"

namespace godwit::io::mavlink {

struct kind_counters {
  std::uint64_t received = 0;
  std::uint64_t bad_crc = 0; // what claimed to be of this kind; false starts count here too
};

struct scan_counters {
  std::uint64_t bytes = 0;
  std::uint64_t frames = 0;        // good ones, handed on
  std::uint64_t bad_crc = 0;       // one damaged frame may count several times, when its payload contains FD
  std::uint64_t unknown_id = 0;    // passed over by their length, their checksum unchecked
  std::uint64_t unknown_flag = 0;  // whole and right, but with an incompatibility flag that we do not know
  std::uint64_t v1_frames = 0;     // MAVLink 1, passed over
  std::uint64_t cut_off = 0;       // a frame began and the datagram ended
  std::uint64_t garbage_bytes = 0; // not part of a frame, good or passed over
  std::array<kind_counters, known_id_count> kinds{}; // by slot, see io/mavlink/ids.hpp

  [[nodiscard]] kind_counters of(std::uint32_t id) const {
    const auto* const info = find_message(id);
    return info != nullptr ? kinds[slot_of(*info)] : kind_counters{};
  }
};

} // namespace godwit::io::mavlink
