// A frame as JPEG, by TurboJPEG, without a turn through RGB. Errors: a sentence. Thread: one at a time.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include <tl/expected.hpp>

#include "io/video/frame.hpp"

namespace godwit::io::video {

class jpeg_encoder {
public:
  explicit jpeg_encoder(int quality); // 1..100
  ~jpeg_encoder();
  jpeg_encoder(const jpeg_encoder&) = delete;
  jpeg_encoder& operator=(const jpeg_encoder&) = delete;

  // Good until the next call.
  [[nodiscard]] tl::expected<std::span<const std::byte>, std::string> encode(const frame& picture);

private:
  struct parts;
  std::unique_ptr<parts> parts_;
};

} // namespace godwit::io::video
