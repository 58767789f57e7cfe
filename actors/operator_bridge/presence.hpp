// Whether somebody who may fly is there: heard, in a session or at the control socket, within as long as control is
// held by who is silent. operator_bridge tells; whoever looks asks.
//
// It outlives the incarnations of the actor. Thread: any.
#pragma once

#include <atomic>
#include <cstdint>

#include "actors/operator_bridge/control.hpp"

namespace godwit::operator_bridge {

class presence {
public:
  void hear(std::int64_t monotonic_ns) { heard_ns_ = monotonic_ns; }
  [[nodiscard]] bool is_there(std::int64_t monotonic_ns) const {
    const auto heard_ns = heard_ns_.load();
    return heard_ns != never && monotonic_ns - heard_ns <= control::silent_ns;
  }

private:
  static constexpr std::int64_t never = -1;
  std::atomic<std::int64_t> heard_ns_ = never;
};

} // namespace godwit::operator_bridge
