// An answer as bytes, piece by piece: so that it can be slow, end early, or be larger than memory.
//
// Thread: as any value. Source: RFC 9112.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "programs/godwit-sim/missions/delivery.hpp"

namespace godwit::sim::missions {

class outgoing {
public:
  // IS_LAST: the connection ends with it, which the head says.
  outgoing(const delivery& from, bool is_last);

  [[nodiscard]] bool is_at_end() const { return offset_ == bytes_.size() && padding_ == 0; }
  // The next bytes, at most MAX and none at the end; good until the next call.
  [[nodiscard]] std::string_view take(std::size_t max);

private:
  std::string bytes_; // the head, and what is to be sent of the body
  std::size_t offset_ = 0;
  std::uint64_t padding_ = 0; // spaces to come
};

} // namespace godwit::sim::missions
