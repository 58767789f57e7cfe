// Speaks to the service manager: datagrams of lines to the socket that $NOTIFY_SOCKET names (a path, or a name that
// begins with @ in Linux's abstract space).
//
// A manager that does not take a datagram now does not get it: nothing here waits. Without a manager all of it does
// nothing. Errors: a socket that can not be used is a sentence. Thread: any.
// Source: sd_notify(3), sd_watchdog_enabled(3), unix(7).
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <sys/un.h>
#include <tl/expected.hpp>

#include "io/link/descriptor.hpp"
#include "runtime/health_board.hpp"

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

// The health of all parts in words, for the log and for the service manager. Thread: pure.

// "all is well", or the worst of it: "red: journal: the disk is full; and 2 more".
[[nodiscard]] std::string health_in_a_line(const std::vector<runtime::health_entry>& now);

struct health_change {
  std::string part;
  runtime::health_colour colour = runtime::health_colour::green;
  std::string sentence; // "journal is red: the disk is full", "journal is well again"
};

// What has another colour than BEFORE. Of a part that nobody had heard of, only what is wrong with it.
[[nodiscard]] std::vector<health_change> health_changes(const std::vector<runtime::health_entry>& before,
                                                        const std::vector<runtime::health_entry>& now);

// Tells the service manager that godwitd is ready, how it is and that it lives; and the log when the health of a part
// changes.
//
//   not ready ──all actors have been up once──> READY=1 ──> each beat: WATCHDOG=1 while the guardian has its turns and
//                                                           sees no reason to end; STATUS= when it is another one
//
// A beat comes at least twice in the watchdog's period. What changes and changes back between two beats is not told;
// the trace has it. Thread: its own; around_reload from any.

// What a watchdog_notifier looks at; called in its thread.
struct pulse_view {
  std::function<bool()> has_begun;
  std::function<bool()> is_responsive;
  std::function<std::vector<runtime::health_entry>()> health;
  std::function<void(const health_change& news)> tell;
};

class watchdog_notifier {
public:
  static constexpr std::chrono::milliseconds until_ready{20}; // between looks
  static constexpr std::chrono::milliseconds max_period{1'000};

  // MANAGER outlives it. ABOUT stands in front of the state, such as the mission.
  watchdog_notifier(const service_manager& manager, pulse_view view, std::string about);
  watchdog_notifier(const watchdog_notifier&) = delete;
  watchdog_notifier& operator=(const watchdog_notifier&) = delete;
  ~watchdog_notifier() { end(); }

  void start();
  // No beat comes any more, and the manager hears no more of reloads.
  void end();
  void beat();
  // RELOAD, and the manager knows of it.
  void around_reload(const std::function<void()>& reload);
  [[nodiscard]] std::chrono::microseconds period() const;

private:
  void run();
  void tell_health();

  const service_manager& manager_;
  const pulse_view view_;
  const std::string about_;

  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_ready_ = false;
  bool is_over_ = false;
  std::vector<runtime::health_entry> last_;
  std::string last_status_;
  std::thread thread_;
};

} // namespace godwit::daemon
