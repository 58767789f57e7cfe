// Signals as something to wait for: from its construction on they make a descriptor readable instead of ending the
// process. To be made before any other thread, which then does not get them either.
//
// Errors: the constructor throws if the system has no descriptor left. Thread: one. Source: signalfd(2).
#pragma once

#include <csignal>
#include <initializer_list>
#include <optional>

#include "io/link/descriptor.hpp"

namespace godwit::programs {

class signal_descriptor {
public:
  enum class afterwards {
    as_before,    // they end the process again; those that came meanwhile are dropped
    still_blocked // the process is ending
  };

  explicit signal_descriptor(std::initializer_list<int> which, afterwards later = afterwards::as_before);
  ~signal_descriptor();
  signal_descriptor(const signal_descriptor&) = delete;
  signal_descriptor& operator=(const signal_descriptor&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_.number(); }
  // One that has come.
  [[nodiscard]] std::optional<int> take() const;

private:
  afterwards later_;
  sigset_t before_{};
  io::link::descriptor descriptor_;
};

// Of a set, for the calls of the system.
[[nodiscard]] sigset_t signal_set(std::initializer_list<int> which);

} // namespace godwit::programs
