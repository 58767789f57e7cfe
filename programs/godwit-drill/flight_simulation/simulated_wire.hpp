// The daemon's end of a link in virtual time: what it sends waits until the world takes it, what it gets is queued as a
// real link does it. It belongs to one process, and dies with it. Thread: one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "io/link/wire.hpp"

namespace godwit::drill {

class simulated_wire final : public io::link::wire {
public:
  using frame = std::vector<std::byte>;

  // WAKE is called when the actor has nothing left to do, as that of io::link::line.
  void open(std::function<void()> wake) {
    wake_ = std::move(wake);
    if (incoming().put(io::link::link_status{io::link::link_phase::up, {}, 0}))
      wake_();
  }

  // FROM: by which peer, as an address on a real line.
  void receive(std::span<const std::byte> bytes, io::link::peer_id from = peer) {
    if (incoming().put(from, bytes, true))
      wake_();
  }

  bool send(std::span<const std::byte> bytes, io::link::peer_id to) override {
    receivers_.push_back(to);
    sent_.emplace_back(bytes.begin(), bytes.end());
    return true;
  }

  // Frames to PEER since note_receivers(), those to everybody among them.
  void note_receivers() { receivers_.clear(); }
  [[nodiscard]] std::size_t sent_to(io::link::peer_id who) const {
    return static_cast<std::size_t>(std::ranges::count(receivers_, who) +
                                    std::ranges::count(receivers_, io::link::every_peer));
  }

  [[nodiscard]] std::vector<frame> take_sent() { return std::exchange(sent_, {}); }

private:
  static constexpr io::link::peer_id peer = 1;

  std::function<void()> wake_;
  std::vector<frame> sent_;
  std::vector<io::link::peer_id> receivers_;
};

} // namespace godwit::drill
