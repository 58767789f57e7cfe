// One socket that speaks with many simulated vehicles at once, each on a port of its own: makes them fly a mission far
// away, and counts what they send.
//
// It has a thread that sleeps in the kernel until a datagram comes. Thread: the public functions by the owner.
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>
#include <unordered_map>
#include <vector>

#include "io/link/descriptor.hpp"
#include "io/mavlink/codec.hpp"
#include "io/mavlink/messages/command.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"
#include "io/mavlink/scanner.hpp"

namespace godwit::tests {

class fleet_station {
public:
  struct vehicle {
    std::uint16_t port = 0;
    std::uint8_t system = 1;
  };

  // MAKES_FLY: else it only says that it is there, so that they send.
  fleet_station(const std::vector<vehicle>& fleet, bool makes_fly);
  ~fleet_station();
  fleet_station(const fleet_station&) = delete;
  fleet_station& operator=(const fleet_station&) = delete;

  [[nodiscard]] std::uint64_t frames() const { return frames_; }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  [[nodiscard]] std::size_t heard_from() const { return heard_from_; }
  [[nodiscard]] std::size_t flying() const { return flying_; }

private:
  // What is asked of a vehicle next; each step waits for its answer.
  enum class step { upload, guided, arm, start, done };
  struct member {
    vehicle who;
    step now = step::done;
    bool is_heard = false;
  };

  void run();
  void speak_to_all();
  void ask(const member& of);
  void heard(member& from, const io::mavlink::frame_view& frame);
  void go_on(member& with);
  void send_item(const member& to, std::uint16_t seq);
  template <class M>
  void send(const member& to, const M& message);
  void command(const member& to, std::uint16_t which, float first, float second);

  io::link::descriptor socket_;
  std::vector<member> fleet_;
  std::unordered_map<std::uint16_t, std::size_t> by_port_;
  io::mavlink::scanner scanner_;
  std::uint8_t sequence_ = 0;
  std::atomic<std::uint64_t> frames_{0};
  std::atomic<std::uint64_t> bytes_{0};
  std::atomic<std::size_t> heard_from_{0};
  std::atomic<std::size_t> flying_{0};
  std::atomic<bool> is_over_{false};
  std::thread thread_;
};

} // namespace godwit::tests
