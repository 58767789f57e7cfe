#include "programs/common/signal_descriptor.hpp"

#include <cerrno>
#include <system_error>

#include <pthread.h>
#include <sys/signalfd.h>
#include <unistd.h>

namespace godwit::programs {

sigset_t signal_set(std::initializer_list<int> which) {
  sigset_t made;
  sigemptyset(&made);
  for (const int each : which)
    sigaddset(&made, each);
  return made;
}

signal_descriptor::signal_descriptor(std::initializer_list<int> which, afterwards later) : later_(later) {
  const auto all = signal_set(which);
  ::pthread_sigmask(SIG_BLOCK, &all, &before_);
  descriptor_ = io::link::descriptor(::signalfd(-1, &all, SFD_CLOEXEC | SFD_NONBLOCK));
  if (!descriptor_.is_open())
    throw std::system_error(errno, std::generic_category(), "signalfd");
}

// Those that came are taken first, or they would end the process here.
signal_descriptor::~signal_descriptor() {
  if (later_ == afterwards::still_blocked)
    return;
  while (take()) {
  }
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

std::optional<int> signal_descriptor::take() const {
  signalfd_siginfo came{};
  if (::read(descriptor(), &came, sizeof came) != sizeof came)
    return std::nullopt;
  return static_cast<int>(came.ssi_signo);
}

} // namespace godwit::programs
