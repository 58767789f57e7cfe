// Ctrl-C and the service manager's word: SIGINT, SIGTERM and SIGHUP as a call instead of the end of the process.
//
// SIGINT and SIGTERM ask for the end, SIGHUP asks to open the log anew and can come any number of times; it is handled
// once in hangup_gap.
// To be made before any other thread, which then does not get them either. A second signal ends the process at once:
// whoever presses Ctrl-C twice means it. Errors: the constructor throws if the system has no descriptor or thread left.
// Thread: the owner's; the callback comes in a thread of its own.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include "io/link/descriptor.hpp"
#include "programs/common/signal_descriptor.hpp"

namespace godwit::daemon {

class signal_handler {
public:
  static constexpr std::chrono::milliseconds hangup_gap{1'000};

  // Blocks the signals.
  signal_handler();
  // Leaves them blocked: the process is ending.
  ~signal_handler();
  signal_handler(const signal_handler&) = delete;
  signal_handler& operator=(const signal_handler&) = delete;

  // NAME: "SIGTERM" or "SIGINT".
  void start(std::function<void(const std::string& name)> on_stop, std::function<void()> on_hangup = {});
  // From now on nothing is called. Before what the callback uses goes.
  void end();

private:
  void run(const std::function<void(const std::string& name)>& on_stop, const std::function<void()>& on_hangup) const;

  programs::signal_descriptor signals_;
  io::link::descriptor stop_;
  std::thread thread_;
};

} // namespace godwit::daemon
