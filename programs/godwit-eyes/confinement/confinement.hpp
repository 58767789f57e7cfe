// Shuts godwit-eyes in before it looks at what strangers send.
//
// It decodes pictures under godwitd's user. Whoever takes over a decoder could read keys and journal, write serial
// lines, connect to the control socket and stop the daemon. So before the first picture the process gives all that up
// but for what a camera needs: programs and libraries, its device or file, the network when the camera is there, the
// folder of its recordings and GStreamer's list of plugins. It keeps the socket and the memory that it shares with the
// daemon.
//
// Errors: a sentence; what could be shut is. Thread: the first, before others begin.
#pragma once

#include <string>
#include <vector>

#include <sys/types.h>
#include <tl/expected.hpp>

#include "io/video/camera_uri.hpp"

namespace godwit::eyes {

// RECORD_FOLDER: is made; empty: none.
[[nodiscard]] tl::expected<void, std::string> confine(const io::video::camera_uri& from,
                                                      const std::string& record_folder);

// A camera that is plugged in again is another device under its name, which a confined process can not open.
class device_identity {
public:
  device_identity() = default; // of no device: it stays
  explicit device_identity(const io::video::camera_uri& from);

  [[nodiscard]] bool is_replaced() const;

private:
  [[nodiscard]] bool look(dev_t& device, ino_t& number) const;

  std::string path_;
  bool was_there_ = false;
  dev_t device_ = 0;
  ino_t number_ = 0;
};

// Which files this thread, and all that it begins, may still open: those that are named, and no others.
//
// What is not there now stays closed when it comes, and what is replaced under its name, too: a rule is about the file
// and not about its name. Symbolic links are followed once, now. Errors: a sentence. Thread: the one that is confined,
// before it begins others.
// Source: landlock(7), and the kernel's Documentation/userspace-api/landlock.rst (ABI 1 to 6).
struct open_paths {
  std::vector<std::string> readable; // files and folders with all below them; programs there may be executed
  std::vector<std::string> writable; // the same, with making and removing
  std::vector<std::string> devices;  // read, written, asked
};

[[nodiscard]] tl::expected<void, std::string> allow_only(const open_paths& paths);

} // namespace godwit::eyes
