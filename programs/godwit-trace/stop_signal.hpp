// Ctrl-C as something to wait for: from its construction on, SIGINT and SIGTERM make a descriptor readable instead of
// ending the process. To be made before any other thread, which then does not get them either.
//
// Errors: the constructor throws if the system has no descriptor left. Thread: one. Source: signalfd(2).
#pragma once

#include <csignal>

namespace godwit::trace_tool {

class stop_signal {
public:
  stop_signal();
  // From here on they end the process again.
  ~stop_signal();
  stop_signal(const stop_signal&) = delete;
  stop_signal& operator=(const stop_signal&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }

private:
  sigset_t before_{};
  int descriptor_ = -1;
};

} // namespace godwit::trace_tool
