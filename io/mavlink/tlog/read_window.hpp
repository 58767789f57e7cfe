// A part of a file in memory that moves towards its end, so that a file of any size is read with the same memory.
//
// Errors: those of the source. Thread: one at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "io/mavlink/wire_format.hpp"
#include "io/mcap/byte_source.hpp"

namespace godwit::io::mavlink {

class read_window {
public:
  static constexpr std::size_t window_bytes = std::size_t{64} << 10;

  // The source must outlive the window.
  explicit read_window(const mcap::byte_source& source) : source_(&source), memory_(window_bytes) {}

  // Reads on until at least COUNT bytes, at most `window_bytes`, are there, or all up to the end of the source. Moves
  // what `bytes` gave before.
  [[nodiscard]] mcap::result<void> require(std::size_t count);

  [[nodiscard]] byte_view bytes() const { return {memory_.data() + begin_, end_ - begin_}; }
  // Where in the source `bytes` begins.
  [[nodiscard]] std::uint64_t offset() const { return offset_; }

  // The first COUNT of `bytes` are done with. They stay where they are until the next `require`.
  void drop(std::size_t count);

private:
  const mcap::byte_source* source_;
  std::vector<std::byte> memory_;
  std::size_t begin_ = 0; // of what was not dropped, in memory_
  std::size_t end_ = 0;
  std::uint64_t offset_ = 0;
};

} // namespace godwit::io::mavlink
