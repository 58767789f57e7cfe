// Ctrl-C and the service manager's word: SIGINT, SIGTERM and SIGHUP as a call instead of the end of the process.
//
// SIGINT and SIGTERM ask for the end, SIGHUP asks to open the log anew and can come any number of times.
// To be made before any other thread, which then does not get them either. A second signal ends the process at once:
// whoever presses Ctrl-C twice means it. Errors: the constructor throws if the system has no descriptor or thread left.
// Thread: the owner's; the callback comes in a thread of its own. Source: signalfd(2).
#pragma once

#include <csignal>
#include <functional>
#include <string>
#include <thread>

#include "io/link/descriptor.hpp"

namespace godwit::daemon {

class stop_watch {
public:
  // Blocks the signals.
  stop_watch();
  // Leaves them blocked: the process is ending.
  ~stop_watch();
  stop_watch(const stop_watch&) = delete;
  stop_watch& operator=(const stop_watch&) = delete;

  // NAME: "SIGTERM" or "SIGINT".
  void start(std::function<void(const std::string& name)> on_stop, std::function<void()> on_hangup = {});
  // From now on nothing is called. Before what the callback uses goes.
  void end();

private:
  void run(const std::function<void(const std::string& name)>& on_stop, const std::function<void()>& on_hangup) const;

  io::link::descriptor signals_;
  io::link::descriptor stop_;
  std::thread thread_;
};

} // namespace godwit::daemon
