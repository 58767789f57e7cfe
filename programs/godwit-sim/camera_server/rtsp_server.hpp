// Serves pictures as RTSP: JPEG, to as many clients as come.
//
// GStreamer's server runs in a thread of its own. A picture that no client waits for is dropped. While it is cut,
// clients stay connected and hear nothing, as with a camera that hangs. Errors: a sentence. Thread: any.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include <tl/expected.hpp>

#include "programs/godwit-sim/camera_server/camera_place.hpp"

namespace godwit::sim {

class rtsp_server {
public:
  [[nodiscard]] static tl::expected<std::unique_ptr<rtsp_server>, std::string> open(const camera_place& where);
  ~rtsp_server();
  rtsp_server(const rtsp_server&) = delete;
  rtsp_server& operator=(const rtsp_server&) = delete;

  // Brightness, row by row without gaps, of the size of the place.
  void push(std::span<const std::uint8_t> grey);
  void set_cut(bool is_cut);
  [[nodiscard]] std::uint16_t port() const; // as it is, for port 0

private:
  struct parts;
  explicit rtsp_server(std::unique_ptr<parts> made);
  std::unique_ptr<parts> parts_;
};

} // namespace godwit::sim
