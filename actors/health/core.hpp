// The health of all parts, the worst of it, and since when.
//
//   health board ──each second──> on_board() ──> health_status, and whether it is another one
//
// A part that nobody has posted is not there. A reason in which only a number is another one is no news: it would be
// told each second. Nothing of it is durable: an incarnation counts from its own beginning. Pure: the time comes in.
// Thread: one owner.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "messages/health/types.hpp"

namespace godwit::health {

// Parts that are shown. There are some thirty actors and as many other parts; more would be a mistake of ours.
inline constexpr std::size_t max_parts = 256;

// What somebody has posted on the board.
struct posted {
  std::string part;
  colour health = colour::green;
  std::string reason;
  GODWIT_FIELDS(posted, "health.posted", part, health, reason);
};

class core {
public:
  // True: listeners are to be told.
  bool on_board(const std::vector<posted>& all, std::int64_t wall_ms);
  [[nodiscard]] const health_status& status() const { return status_; }

private:
  health_status status_;
};

} // namespace godwit::health
