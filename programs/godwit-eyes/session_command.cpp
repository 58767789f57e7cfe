// The command `session`: what godwitd starts. The socket is descriptor 3, the memory for pictures descriptor 4.
#include <sys/resource.h>
#include <unistd.h>

#include "programs/godwit-eyes/commands.hpp"
#include "programs/godwit-eyes/confinement/confinement.hpp"
#include "programs/godwit-eyes/detection/detector.hpp"
#include "programs/godwit-eyes/session/session.hpp"

namespace godwit::eyes {
namespace {

constexpr int socket_number = 3;
constexpr int slot_number = 4;
constexpr int less_urgent = 5; // than the daemon, which flies

exit_code serve_daemon() {
  auto slot = io::eyes::picture_slot::attach(io::link::descriptor(slot_number));
  if (!slot) {
    say("is started by godwitd: " + slot.error());
    return exit_code::usage;
  }
  keep_freed_memory();
  static_cast<void>(::setpriority(PRIO_PROCESS, 0, less_urgent));
  io::eyes::channel to_daemon{io::link::descriptor(socket_number)};
  device_identity device;
  session_hooks hooks;
  hooks.before_work = [&device](const io::eyes::begin& wanted, const io::video::camera_uri& from) {
    device = device_identity(from);
    if (const auto confined = confine(from, wanted.record_folder); !confined)
      say("is not shut in: who takes over a decoder of pictures could read what godwitd can; " + confined.error());
  };
  hooks.is_camera_replaced = [&device] { return device.is_replaced(); };
  switch (run_session(to_daemon, *slot, std::move(hooks))) {
  case session_end::closed:
    ::_exit(static_cast<int>(exit_code::ok)); // a driver may hang in what threads do at an end
  case session_end::garbage:
    say("what came from godwitd is no message: the two programs are of different builds");
    break;
  case session_end::stuck:
    say("the driver of the camera does not come back");
    break;
  case session_end::replaced:
    say("the camera was plugged in again");
    break;
  }
  ::_exit(static_cast<int>(exit_code::failed));
}

} // namespace

command add_session_command(CLI::App& to) {
  return {to.add_subcommand("session", "Started by godwitd; not for people"), serve_daemon};
}

} // namespace godwit::eyes
