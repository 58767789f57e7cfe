// The daemon's end of a link in virtual time: what it sends waits until the world takes it, what it gets is queued as a
// real link does it. It belongs to one process, and dies with it. Thread: one.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "io/link/wire.hpp"

namespace godwit::tests {

class simulated_wire final : public io::link::wire {
public:
  using frame = std::vector<std::byte>;

  // WAKE is called when the actor has nothing left to do, as that of io::link::line.
  void open(std::function<void()> wake) {
    wake_ = std::move(wake);
    if (incoming().put(io::link::link_status{io::link::link_phase::up, {}, 0}))
      wake_();
  }

  void receive(std::span<const std::byte> bytes) {
    if (incoming().put(peer, bytes, true))
      wake_();
  }

  bool send(std::span<const std::byte> bytes, io::link::peer_id) override {
    sent_.emplace_back(bytes.begin(), bytes.end());
    return true;
  }

  [[nodiscard]] std::vector<frame> take_sent() { return std::exchange(sent_, {}); }

private:
  static constexpr io::link::peer_id peer = 1;

  std::function<void()> wake_;
  std::vector<frame> sent_;
};

} // namespace godwit::tests
