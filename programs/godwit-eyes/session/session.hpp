// What godwit-eyes does for the daemon: waits for `begin`, then watches the camera and says what it sees until the
// socket is closed.
//
// It says how it is each half second, whatever the camera does. A driver that does not come back for `stuck_limit` ends
// the process: nothing else takes it out of the call, and the daemon starts a new one. Errors: in the status. Thread:
// the caller's, until it returns; others of its own.
#pragma once

#include <chrono>
#include <functional>

#include "io/eyes/channel.hpp"
#include "io/eyes/picture_slot.hpp"
#include "io/video/camera_uri.hpp"

namespace godwit::eyes {

inline constexpr std::chrono::milliseconds status_period{500};
// Above what GStreamer takes to look through its plugins at the first start on a busy computer.
inline constexpr std::chrono::seconds stuck_limit{20};

enum class session_end {
  closed,  // by the daemon
  garbage, // what came is no message: the two are of different builds
  stuck,   // the driver of the camera does not come back
  replaced // another camera has its name, which this process may not open
};

struct session_hooks {
  // The daemon has named a camera; before any thread works on it.
  std::function<void(const io::eyes::begin& wanted, const io::video::camera_uri& from)> before_work = {};
  // Asked while it does not play.
  std::function<bool()> is_camera_replaced = {};
};

// After `stuck` its threads can not be waited for: the process has to end at once, with _exit.
[[nodiscard]] session_end run_session(io::eyes::channel& to_daemon, io::eyes::picture_slot& slot,
                                      session_hooks hooks = {});

} // namespace godwit::eyes
