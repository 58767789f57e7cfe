// A picture of the generator as one of a camera, without colour. Thread: any.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "io/video/frame.hpp"
#include "programs/godwit-sim/camera/generator.hpp"

namespace godwit::eyes::test {

[[nodiscard]] inline io::video::frame frame_of(sim::camera::picture seen, std::int64_t captured_ns) {
  constexpr std::uint8_t no_colour = 128;
  const std::vector<std::uint8_t> colour(seen.grey.size(), no_colour);
  const auto held =
      std::make_shared<std::pair<sim::camera::picture, std::vector<std::uint8_t>>>(std::move(seen), colour);
  const auto width = static_cast<std::size_t>(held->first.width);
  io::video::frame result;
  result.captured_ns = captured_ns;
  result.width = held->first.width;
  result.height = held->first.height;
  result.planes = {{{held->first.grey.data(), width}, {held->second.data(), width}, {held->second.data(), width}}};
  result.owner = held;
  return result;
}

} // namespace godwit::eyes::test
