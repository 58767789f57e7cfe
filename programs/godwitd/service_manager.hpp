// Speaks to the service manager: datagrams of lines to the socket that $NOTIFY_SOCKET names (a path, or a name that
// begins with @ in Linux's abstract space).
//
// A manager that does not take a datagram now does not get it: nothing here waits. Without a manager all of it does
// nothing. Errors: a socket that can not be used is a sentence. Thread: any.
// Source: sd_notify(3), sd_watchdog_enabled(3), unix(7).
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include <sys/un.h>
#include <tl/expected.hpp>

#include "io/link/descriptor.hpp"

namespace godwit::daemon {

class service_manager {
public:
  static constexpr std::size_t max_status = 200; // bytes of STATUS=, which people read in one line

  // There is none.
  service_manager() = default;
  // SOCKET as $NOTIFY_SOCKET has it.
  [[nodiscard]] static tl::expected<service_manager, std::string> at(const std::string& socket,
                                                                     std::optional<std::chrono::microseconds> watchdog);
  // $NOTIFY_SOCKET, and $WATCHDOG_USEC if $WATCHDOG_PID is this process or is not there.
  [[nodiscard]] static tl::expected<service_manager, std::string> from_environment();

  void tell_ready() const { send("READY=1"); }
  void tell_status(std::string_view sentence) const;
  void tell_reloading() const; // tell_ready() when done
  void tell_stopping() const { send("STOPPING=1"); }
  void tell_alive() const { send("WATCHDOG=1"); }

  // Who is not heard of for so long is killed and started again. None: nobody watches.
  [[nodiscard]] std::optional<std::chrono::microseconds> watchdog() const { return watchdog_; }

private:
  void send(std::string_view lines) const;

  io::link::descriptor socket_; // none: no manager
  sockaddr_un address_{};
  socklen_t address_size_ = 0;
  std::optional<std::chrono::microseconds> watchdog_;
};

} // namespace godwit::daemon
