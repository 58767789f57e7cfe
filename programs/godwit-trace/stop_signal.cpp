#include "programs/godwit-trace/stop_signal.hpp"

#include <cerrno>
#include <system_error>

#include <pthread.h>
#include <sys/signalfd.h>
#include <unistd.h>

namespace godwit::trace_tool {

stop_signal::stop_signal() {
  sigset_t stops;
  sigemptyset(&stops);
  sigaddset(&stops, SIGINT);
  sigaddset(&stops, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &stops, &before_);
  descriptor_ = ::signalfd(-1, &stops, SFD_CLOEXEC | SFD_NONBLOCK);
  if (descriptor_ < 0)
    throw std::system_error(errno, std::generic_category(), "signalfd");
}

// Those that came are taken first, or they would end the process here.
stop_signal::~stop_signal() {
  signalfd_siginfo came{};
  while (::read(descriptor_, &came, sizeof came) > 0) {
  }
  ::close(descriptor_);
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

} // namespace godwit::trace_tool
