// A line in virtual time with the vices of real ones: it delays, loses, doubles and overtakes frames, and is slow.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <random>

#include "tests/support/virtual_time.hpp"

namespace godwit::tests {

struct line_settings {
  std::int64_t delay_ns = 15'000'000; // each way
  std::int64_t jitter_ns = 0;         // added at random, up to this; frames then overtake each other
  double loss = 0;                    // of each frame, each way
  double duplication = 0;
  int baud = 0; // half-duplex with 10 bits for a byte; 0: no limit
};

class simulated_line {
public:
  enum direction { up = 0, down = 1 };

  simulated_line(virtual_time& time, const line_settings& settings, std::uint64_t seed)
      : time_(time), settings_(settings), random_(seed) {}

  // Calls DELIVER when a frame of BYTES has come through, once, twice or not at all.
  void send(direction to, std::size_t bytes, const std::function<void()>& deliver) {
    bytes_[to] += bytes;
    // Both ends share the line: what is sent waits for what is under way. A lost frame takes its time as well.
    const auto begins_ns = std::max(time_.now_ns(), free_at_ns_);
    const auto ends_ns = begins_ns + duration_ns(bytes);
    if (settings_.baud != 0)
      free_at_ns_ = ends_ns;
    if (happens(settings_.loss) || is_cut_)
      return;
    time_.at(ends_ns + settings_.delay_ns + jitter_ns(), deliver);
    if (happens(settings_.duplication))
      time_.at(ends_ns + settings_.delay_ns + jitter_ns(), deliver);
  }

  // Nothing comes through while it is cut.
  void cut(bool is_cut) { is_cut_ = is_cut; }

  [[nodiscard]] std::uint64_t bytes(direction to) const { return bytes_[to]; }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_[up] + bytes_[down]; }

  [[nodiscard]] std::int64_t duration_ns(std::size_t bytes) const {
    constexpr std::int64_t bits_per_byte = 10;
    return settings_.baud == 0 ? 0 : static_cast<std::int64_t>(bytes) * bits_per_byte * 1'000'000'000 / settings_.baud;
  }

private:
  [[nodiscard]] bool happens(double probability) {
    return probability > 0 && std::uniform_real_distribution<>(0, 1)(random_) < probability;
  }
  [[nodiscard]] std::int64_t jitter_ns() {
    return settings_.jitter_ns == 0 ? 0 : std::uniform_int_distribution<std::int64_t>(0, settings_.jitter_ns)(random_);
  }

  virtual_time& time_;
  line_settings settings_;
  std::mt19937_64 random_;
  std::int64_t free_at_ns_ = 0;
  std::uint64_t bytes_[2] = {};
  bool is_cut_ = false;
};

} // namespace godwit::tests
