// One pipeline of GStreamer, from a camera to pictures in I420. Made, played and ended by one thread; see source.hpp.
//
// Errors: sentences with a remedy where one is known. Thread: `on_picture` is called in GStreamer's threads.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "io/video/camera_uri.hpp"
#include "io/video/frame.hpp"

namespace godwit::io::video {

class pipeline {
public:
  using picture_taker = std::function<void(frame picture)>;

  [[nodiscard]] static tl::expected<std::unique_ptr<pipeline>, std::string> make(const camera_uri& from, bool is_paced,
                                                                                 picture_taker on_picture);
  ~pipeline(); // may block as long as a driver does
  pipeline(const pipeline&) = delete;
  pipeline& operator=(const pipeline&) = delete;

  [[nodiscard]] tl::expected<void, std::string> play(); // may block as long as a driver does

  struct news {
    bool has_ended = false;
    std::string error; // empty: none
  };
  // Waits for so long.
  [[nodiscard]] std::optional<news> wait(std::chrono::milliseconds most);

private:
  struct parts;
  explicit pipeline(std::unique_ptr<parts> made);
  std::unique_ptr<parts> parts_;
};

} // namespace godwit::io::video
