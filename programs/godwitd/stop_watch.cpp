#include "programs/godwitd/stop_watch.hpp"

#include <array>
#include <cerrno>
#include <cstdint>
#include <system_error>
#include <utility>

#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

namespace godwit::daemon {
namespace {

sigset_t stop_signals() {
  sigset_t result;
  sigemptyset(&result);
  sigaddset(&result, SIGINT);
  sigaddset(&result, SIGTERM);
  return result;
}

sigset_t watched_signals() {
  auto result = stop_signals();
  sigaddset(&result, SIGHUP);
  return result;
}

} // namespace

stop_watch::stop_watch() : stop_(::eventfd(0, EFD_CLOEXEC)) {
  const auto signals = watched_signals();
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  signals_ = io::link::descriptor(::signalfd(-1, &signals, SFD_CLOEXEC));
  if (!stop_.is_open() || !signals_.is_open())
    throw std::system_error(errno, std::generic_category(), "signalfd");
}

stop_watch::~stop_watch() { end(); }

void stop_watch::end() {
  const std::uint64_t one = 1;
  (void)!::write(stop_.number(), &one, sizeof one);
  if (thread_.joinable())
    thread_.join();
}

void stop_watch::start(std::function<void(const std::string& name)> on_stop, std::function<void()> on_hangup) {
  thread_ =
      std::thread([this, on_stop = std::move(on_stop), on_hangup = std::move(on_hangup)] { run(on_stop, on_hangup); });
}

void stop_watch::run(const std::function<void(const std::string& name)>& on_stop,
                     const std::function<void()>& on_hangup) const {
  for (int seen = 0;;) {
    std::array<pollfd, 2> watched{pollfd{signals_.number(), POLLIN, 0}, pollfd{stop_.number(), POLLIN, 0}};
    if (::poll(watched.data(), watched.size(), -1) < 0)
      continue;
    if (watched[1].revents != 0)
      return;
    signalfd_siginfo came{};
    if (::read(signals_.number(), &came, sizeof came) != sizeof came)
      continue;
    if (came.ssi_signo == SIGHUP) {
      if (on_hangup)
        on_hangup();
      continue;
    }
    if (++seen == 1) {
      on_stop(came.ssi_signo == SIGTERM ? "SIGTERM" : "SIGINT");
      continue;
    }
    const auto signals = stop_signals();
    ::signal(static_cast<int>(came.ssi_signo), SIG_DFL);
    ::pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    ::raise(static_cast<int>(came.ssi_signo));
  }
}

} // namespace godwit::daemon
