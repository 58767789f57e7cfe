#include "programs/godwitd/daemon.hpp"

#include <unistd.h>

#include "programs/godwitd/console.hpp"
#include "programs/godwitd/stop_watch.hpp"

namespace godwit::daemon {

using runtime::exit_code;

exit_code run_daemon(daemon_settings wanted, const add_more& more) {
  stop_watch stops; // before any thread
  sim::line_printer printer(STDOUT_FILENO);
  auto made = composition::make(std::move(wanted), printer);
  if (!made) {
    say(made.error());
    return exit_code::failed;
  }
  if (more)
    more(**made);
  auto& actors = (*made)->host().actors();
  const struct before_they_go { // also a signal in the last moment must find them
    stop_watch& stops;
    ~before_they_go() { stops.end(); }
  } guard{stops};
  stops.start([&actors](const std::string& name) { actors.request_exit({runtime::exit_cause::requested, name}); });
  if (const auto opened = (*made)->open(); !opened) {
    say(opened.error());
    return static_cast<exit_code>((*made)->close(exit_code::failed));
  }
  const auto why = actors.wait_for_exit_request();
  auto code = runtime::exit_code_for(why.cause);
  const auto ended = (*made)->end_of_run();
  if (code == exit_code::ok && ended && !ended->well)
    code = exit_code::failed;
  if (code != exit_code::ok)
    say(ended && !ended->well ? ended->why : why.reason);
  else if (!ended)
    printer.push("ends: " + why.reason);
  return static_cast<exit_code>((*made)->close(code));
}

} // namespace godwit::daemon
