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

} // namespace godwit::eyes
