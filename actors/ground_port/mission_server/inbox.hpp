// What came in and waits for its turn: an autopilot takes one message of a transfer in each turn of its main loop.
//
// A turn comes each turn_ns, counted from time 0, whether or not anything waits. With turn_ns 0 nothing waits longer
// than the call. When it is full the newest is dropped, as a receive buffer does. Thread: one at a time.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <variant>

#include "io/mavlink/frame.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"
#include "io/mavlink/messages/mission_write_partial_list.hpp"

namespace godwit::ground_port::mission_server {

using incoming =
    std::variant<io::mavlink::mission_count, io::mavlink::mission_item_int, io::mavlink::mission_item,
                 io::mavlink::mission_request, io::mavlink::mission_request_int, io::mavlink::mission_request_list,
                 io::mavlink::mission_ack, io::mavlink::mission_clear_all, io::mavlink::mission_write_partial_list>;

struct letter {
  io::mavlink::sender from;
  incoming what;
};

// 5 kB of items. All of them take an ArduPilot Rover 1.9 s, so that with its patience of 8 s it is idle after 10 s.
inline constexpr std::size_t max_waiting_messages = 96;

class inbox {
public:
  explicit inbox(std::int64_t turn_ns) : turn_ns_(turn_ns) {}

  void put(const letter& each, std::int64_t now_ns);
  // The oldest, if its turn has come at NOW. It takes the turn.
  [[nodiscard]] std::optional<letter> take(std::int64_t now_ns);

  [[nodiscard]] std::int64_t next_turn_ns() const {
    return waiting_.empty() ? std::numeric_limits<std::int64_t>::max() : turn_at_ns_;
  }
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

private:
  [[nodiscard]] std::int64_t turn_after(std::int64_t now_ns) const;

  std::int64_t turn_ns_;
  std::int64_t turn_at_ns_ = 0; // of the oldest
  std::deque<letter> waiting_;
  std::uint64_t dropped_ = 0;
};

} // namespace godwit::ground_port::mission_server
