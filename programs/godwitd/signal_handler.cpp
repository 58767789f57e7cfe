#include "programs/godwitd/signal_handler.hpp"

#include <array>
#include <cerrno>
#include <cstdint>
#include <system_error>
#include <utility>

#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <unistd.h>

namespace godwit::daemon {

using programs::signal_descriptor;

signal_handler::signal_handler()
    : signals_({SIGINT, SIGTERM, SIGHUP}, signal_descriptor::afterwards::still_blocked),
      stop_(::eventfd(0, EFD_CLOEXEC)) {
  if (!stop_.is_open())
    throw std::system_error(errno, std::generic_category(), "eventfd");
}

signal_handler::~signal_handler() { end(); }

void signal_handler::end() {
  const std::uint64_t one = 1;
  (void)!::write(stop_.number(), &one, sizeof one);
  if (thread_.joinable())
    thread_.join();
}

void signal_handler::start(std::function<void(const std::string& name)> on_stop, std::function<void()> on_hangup) {
  thread_ =
      std::thread([this, on_stop = std::move(on_stop), on_hangup = std::move(on_hangup)] { run(on_stop, on_hangup); });
}

void signal_handler::run(const std::function<void(const std::string& name)>& on_stop,
                         const std::function<void()>& on_hangup) const {
  for (int seen = 0;;) {
    std::array<pollfd, 2> watched{pollfd{signals_.descriptor(), POLLIN, 0}, pollfd{stop_.number(), POLLIN, 0}};
    if (::poll(watched.data(), watched.size(), -1) < 0)
      continue;
    if (watched[1].revents != 0)
      return;
    const auto came = signals_.take();
    if (!came)
      continue;
    if (*came == SIGHUP) {
      if (on_hangup)
        on_hangup();
      continue;
    }
    if (++seen == 1) {
      on_stop(*came == SIGTERM ? "SIGTERM" : "SIGINT");
      continue;
    }
    const auto stops = programs::signal_set({SIGINT, SIGTERM});
    ::signal(*came, SIG_DFL);
    ::pthread_sigmask(SIG_UNBLOCK, &stops, nullptr);
    ::raise(*came);
  }
}

} // namespace godwit::daemon
