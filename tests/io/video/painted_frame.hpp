// A frame of one colour, for tests. Thread: any.
#pragma once

#include <memory>
#include <vector>

#include "io/video/frame.hpp"

namespace godwit::io::video {

inline frame painted_frame(std::int32_t width, std::int32_t height, std::uint8_t brightness, std::int64_t captured_ns) {
  const auto stride = static_cast<std::size_t>(width) + 3; // rows need not touch
  const auto pixels =
      std::make_shared<std::vector<std::uint8_t>>(stride * static_cast<std::size_t>(height), brightness);
  const auto colour = std::make_shared<std::vector<std::uint8_t>>(stride * static_cast<std::size_t>(height), 128);
  frame result;
  result.captured_ns = captured_ns;
  result.width = width;
  result.height = height;
  result.planes = {{{pixels->data(), stride}, {colour->data(), stride}, {colour->data(), stride}}};
  result.owner = std::make_shared<std::pair<decltype(pixels), decltype(colour)>>(pixels, colour);
  return result;
}

} // namespace godwit::io::video
