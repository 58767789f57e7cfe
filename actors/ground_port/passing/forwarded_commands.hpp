// Commands of stations that have gone on to the vehicle, until it answers them: its COMMAND_ACK is matched to them
// here, once.
//
// The ack names the station and the command alone, so all of both are answered by it. A repetition may come when the
// vehicle has answered already. Over the bound, and after known_for_ns, the oldest is forgotten: the executor waits no
// longer than that itself. Pure. Times: ns, monotonic. Thread: one at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/mavlink/frame.hpp"

namespace godwit::ground_port::passing {

class forwarded_commands {
public:
  static constexpr std::size_t max_forwarded = 64;
  static constexpr std::int64_t known_for_ns = 3'000'000'000;

  // ANSWERED_AS: the numbers of MAV_CMD with which an autopilot may answer it.
  void put(io::mavlink::sender by, std::array<std::uint16_t, 2> answered_as, std::uint64_t number, std::int64_t now_ns);
  // The numbers of those that this is the answer to, the oldest first.
  [[nodiscard]] std::vector<std::uint64_t> acknowledge(io::mavlink::sender to, std::uint16_t command,
                                                       std::int64_t now_ns);

  // One of them is not answered.
  [[nodiscard]] bool is_waiting(std::int64_t now_ns) {
    forget_old(now_ns);
    return !waiting_.empty();
  }

private:
  struct forwarded {
    io::mavlink::sender by;
    std::array<std::uint16_t, 2> answered_as;
    std::uint64_t number = 0;
    std::int64_t since_ns = 0;
  };
  void forget_old(std::int64_t now_ns);

  std::vector<forwarded> waiting_;
};

} // namespace godwit::ground_port::passing
