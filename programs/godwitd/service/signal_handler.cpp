#include "programs/godwitd/service/signal_handler.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <optional>
#include <system_error>
#include <utility>

#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <unistd.h>

namespace godwit::daemon {

using programs::signal_descriptor;

namespace {

// The first SIGHUP counts at once; those that come within hangup_gap of it are one, after that.
class hangup_gate {
public:
  void note() { is_due_ = true; }
  // For poll(2).
  [[nodiscard]] int wait_ms() const {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(next_ - clock::now());
    return !is_due_ ? -1 : static_cast<int>(std::max<std::int64_t>(0, left.count()));
  }
  [[nodiscard]] bool take_due() {
    const auto now = clock::now();
    if (!is_due_ || now < next_)
      return false;
    is_due_ = false;
    next_ = now + signal_handler::hangup_gap;
    return true;
  }

private:
  using clock = std::chrono::steady_clock;

  bool is_due_ = false;
  clock::time_point next_ = clock::now();
};

} // namespace

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
  hangup_gate hangups;
  for (int seen = 0;;) {
    std::array<pollfd, 2> watched{pollfd{signals_.descriptor(), POLLIN, 0}, pollfd{stop_.number(), POLLIN, 0}};
    if (::poll(watched.data(), watched.size(), hangups.wait_ms()) < 0)
      continue;
    if (watched[1].revents != 0)
      return;
    if (hangups.take_due() && on_hangup)
      on_hangup();
    const auto came = watched[0].revents != 0 ? signals_.take() : std::nullopt;
    if (!came)
      continue;
    if (*came == SIGHUP) {
      hangups.note();
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
