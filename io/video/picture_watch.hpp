// Notices pictures that come and show nothing: black ones, and the same one again and again.
//
// A sample of 64 x 36 pixels decides. One second of it is a fault, so that a cut in a film or a hand before the lens is
// none; the first picture that is sound ends it. A real camera's noise never repeats. Thread: one at a time.
#pragma once

#include <array>
#include <cstdint>

#include "io/video/frame.hpp"

namespace godwit::io::video {

enum class picture_fault { none, black, repeated };

class picture_watch {
public:
  static constexpr std::int64_t patience_ns = 1'000'000'000;
  static constexpr std::uint32_t black_below = 24; // mean brightness; video black is 16
  static constexpr std::uint8_t light_from = 64;   // a pixel of that is a lamp: it is night, and the lens is open

  [[nodiscard]] picture_fault look(const frame& picture);

private:
  static constexpr std::size_t columns = 64;
  static constexpr std::size_t rows = 36;
  using sample = std::array<std::uint8_t, columns * rows>;

  sample last_{};
  bool has_last_ = false;
  std::int64_t sound_ns_ = 0;   // of the newest picture that was not black; 0: none yet
  std::int64_t changed_ns_ = 0; // of the newest that was another one than before
};

} // namespace godwit::io::video
