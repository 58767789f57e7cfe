// Whether somebody who may fly is there: heard, in a session or at the control socket, within as long as control is
// held by who is silent. operator_bridge tells; whoever looks asks.
//
// It outlives the incarnations of the actor. Thread: any.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <utility>

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

// Who has to know when a session ends: the port, which closes what was opened with it. Thread: any.
class session_ends {
public:
  using listener = std::function<void(const std::string& session)>;

  // Must be quick. None: nobody has to know any more.
  void listen(listener who) {
    const std::lock_guard guard(mutex_);
    who_ = std::move(who);
  }
  void notify(const std::string& session) {
    const std::lock_guard guard(mutex_);
    if (who_)
      who_(session);
  }

private:
  std::mutex mutex_; // over who_, also while it runs
  listener who_;
};

} // namespace godwit::operator_bridge
