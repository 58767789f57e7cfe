// The newest picture for operators, as JPEG, in memory that two processes share: the newest wins, and nobody waits.
// Beside it small ones of what moves: cut-outs, the newest of each track.
//
//   head: magic, number of the newest picture | buffer 0 | buffer 1 | buffer 2 | cut-outs 0 ... max_cutouts - 1
//
// The writer fills the buffer after the newest one and then raises the number (a sequence lock over three buffers), so
// a reader has the time of two pictures to copy one; if the number has risen by more meanwhile, it looks again. The
// memory is sealed: nobody can make it shorter, which would end a reader by SIGBUS. A reader believes nothing of what
// is in it: sizes are checked, and the bytes are a JPEG only to whoever decodes them. Errors: sentences. Thread: one
// writer; reading from any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "io/link/descriptor.hpp"

namespace godwit::io::eyes {

inline constexpr std::size_t max_picture_bytes = 1024 * 1024;
inline constexpr std::size_t max_cutout_bytes = 24 * 1024;
inline constexpr std::size_t max_cutouts = 64; // tracks with the same remainder share a place

struct picture {
  std::uint64_t number = 0; // rises from 1
  std::int64_t captured_ns = 0;
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  std::vector<std::byte> jpeg;
};

// A candidate with some of what is around it.
struct cutout {
  std::uint32_t track = 0;
  std::int64_t captured_ns = 0; // above 0
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  std::vector<std::byte> jpeg;
};

class picture_slot {
public:
  // New memory, with nothing in it.
  [[nodiscard]] static tl::expected<picture_slot, std::string> make();
  // That of somebody else.
  [[nodiscard]] static tl::expected<picture_slot, std::string> attach(link::descriptor memory);
  ~picture_slot();
  picture_slot(picture_slot&& other) noexcept;
  picture_slot& operator=(picture_slot&&) = delete;

  // False: it is too large.
  bool publish(std::span<const std::byte> jpeg, std::int64_t captured_ns, std::int32_t width_px,
               std::int32_t height_px);
  // The newest one with a number above AFTER.
  [[nodiscard]] std::optional<picture> read(std::uint64_t after = 0) const;
  // Of one thread, which may be another one than that of publish(). False: it is too large, or its time is none.
  bool publish_cutout(std::uint32_t track, std::span<const std::byte> jpeg, std::int64_t captured_ns,
                      std::int32_t width_px, std::int32_t height_px);
  // Nothing: there is none, or another track took its place.
  [[nodiscard]] std::optional<cutout> read_cutout(std::uint32_t track) const;
  void clear(); // of whoever made it, while nobody writes

  [[nodiscard]] int number() const { return memory_.number(); }

private:
  struct layout;
  picture_slot(link::descriptor memory, layout* mapped) : memory_(std::move(memory)), mapped_(mapped) {}
  [[nodiscard]] static tl::expected<layout*, std::string> map(int number);

  link::descriptor memory_;
  layout* mapped_;
};

} // namespace godwit::io::eyes
