// Tells the service manager that godwitd is ready, how it is and that it lives; and the log when the health of a part
// changes.
//
//   not ready ──all actors have been up once──> READY=1 ──> each beat: WATCHDOG=1 while the guardian has its turns and
//                                                           sees no reason to end; STATUS= when it is another one
//
// A beat comes at least twice in the watchdog's period. What changes and changes back between two beats is not told;
// the trace has it. Thread: its own; around_reload from any.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "programs/godwitd/health_text.hpp"
#include "programs/godwitd/service_manager.hpp"

namespace godwit::daemon {

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
