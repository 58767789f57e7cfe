// What the parts of the core have in common while they decide about one event. Included by core*.cpp alone.
#pragma once

#include <utility>

#include "actors/vehicle_link/core.hpp"

namespace godwit::vehicle_link {

// Collects the effects of one event. Frames go to the vehicle, as soon as it is known where that is.
class core::decision_context {
public:
  decision_context(core& owner, instant when) : core_(owner), now(when) {}

  template <sent M>
  void send(const M& message) {
    if (auto frame = core_.channel_.pack(message, core_.ourselves(), now.wall_ns))
      done.emplace_back(transmission{core_.way_out(), *frame});
  }
  void announce(announcement what) { done.emplace_back(std::move(what)); }

private:
  core& core_;

public:
  instant now;
  effects done;
};

} // namespace godwit::vehicle_link
