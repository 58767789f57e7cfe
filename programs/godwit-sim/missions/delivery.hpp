// An answer, and how it goes over the wire. Thread: plain values.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "programs/godwit-sim/missions/exchange.hpp"

namespace godwit::sim::missions {

struct delivery {
  answer what;
  std::chrono::nanoseconds delay{0};
  std::uint64_t bytes_per_s = 0;        // 0: as fast as it goes
  std::optional<std::size_t> cut_after; // reset after so many bytes of the body
  std::uint64_t padding = 0;            // spaces behind the body
  bool is_lost = false;                 // reset before the first byte
};

} // namespace godwit::sim::missions
