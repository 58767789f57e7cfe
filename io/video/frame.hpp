// One picture of a camera: brightness and two planes of colour at half its size (I420).
//
// The pixels lie in a buffer of GStreamer's, which this keeps alive: sharing a frame copies nothing. They do not
// change. Thread: any.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <memory>

namespace godwit::io::video {

struct plane {
  const std::uint8_t* pixels = nullptr;
  std::size_t stride = 0; // bytes from one row to the next
};

struct frame {
  std::int64_t captured_ns = 0; // monotonic, when it came out of the decoder; above that of the frame before
  std::int64_t stream_ns = -1;  // where it stands in its recording; -1: the stream does not say
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::array<plane, 3> planes; // brightness, blue difference, red difference
  std::shared_ptr<const void> owner;
};

// The clock by which pictures are stamped: CLOCK_MONOTONIC, which every process of this computer shares. Thread: any.
[[nodiscard]] inline std::int64_t monotonic_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

} // namespace godwit::io::video
