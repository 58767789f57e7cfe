// A ground station and its operator in virtual time: heartbeats once a second, MISSION_START on request. Thread: one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>

#include "io/mavlink/frame.hpp"
#include "io/mavlink/messages.hpp"
#include "io/mavlink/scanner.hpp"

namespace godwit::tests {

class simulated_station {
public:
  static constexpr std::int64_t heartbeat_every_ns = 1'000'000'000;
  static constexpr io::mavlink::sender self{255, 190};

  using frame_sink = std::function<void(std::span<const std::byte>)>;

  explicit simulated_station(frame_sink send) : send_(std::move(send)) {}

  void on_time(std::int64_t now_ns);
  [[nodiscard]] std::int64_t next_deadline_ns() const { return next_heartbeat_ns_; }
  void receive(std::span<const std::byte> bytes);

  void start_mission();
  // Heartbeats come no more, as when the operator's radio is off.
  void fall_silent() { is_silent_ = true; }

  [[nodiscard]] const std::optional<io::mavlink::command_ack>& start_answer() const { return start_answer_; }

private:
  template <class M>
  void send(const M& what) {
    send_(io::mavlink::encode(what, self, sequence_++).span());
  }

  frame_sink send_;
  io::mavlink::scanner scanner_;
  std::uint8_t sequence_ = 0;
  std::int64_t next_heartbeat_ns_ = 0;
  bool is_silent_ = false;
  std::optional<io::mavlink::command_ack> start_answer_;
};

} // namespace godwit::tests
