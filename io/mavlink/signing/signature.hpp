// The 13 bytes that end a signed frame, and the hash in them.
//
//   link id 1 | timestamp 6, little-endian | first 6 bytes of SHA-256(key, frame from FD to its checksum, link id,
//   timestamp)
//
// The hash object keeps its working memory, because making one for each frame costs more than the hash. Thread: one at
// a time. Source: the MAVLink guide, "Message Signing"; FIPS 180-4.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "io/mavlink/frame.hpp"
#include "io/mavlink/signing/secret_key.hpp"

namespace godwit::io::mavlink {

// The time in signatures: 48 bits, in units of 10 microseconds since 2015-01-01 00:00 UTC, which last until 2104.
//
// A type of its own, so that it is never mixed up with nanoseconds. Thread: pure. Source: the MAVLink guide, "Message
// Signing".
enum class signing_time : std::uint64_t {};

inline constexpr signing_time max_signing_time{(std::uint64_t{1} << 48U) - 1};
inline constexpr std::int64_t signing_epoch_s = 1'420'070'400; // 2015-01-01 in seconds since 1970
inline constexpr std::int64_t signing_unit_ns = 10'000;
inline constexpr std::uint64_t signing_units_per_s = 100'000;
inline constexpr std::size_t signing_time_size = 6; // bytes on the wire, little-endian

[[nodiscard]] constexpr std::uint64_t units(signing_time time) { return static_cast<std::uint64_t>(time); }

// WALL_NS is nanoseconds since 1970, UTC. A clock that was never set gives the beginning, never something wrapped.
[[nodiscard]] constexpr signing_time signing_time_at(std::int64_t wall_ns) {
  constexpr std::int64_t epoch_ns = signing_epoch_s * 1'000'000'000;
  const std::int64_t since_ns = std::max<std::int64_t>(wall_ns, epoch_ns) - epoch_ns;
  return signing_time{
      std::min<std::uint64_t>(static_cast<std::uint64_t>(since_ns / signing_unit_ns), units(max_signing_time))};
}

// TIME and a DURATION in units later, at most the last time that there is.
[[nodiscard]] constexpr signing_time later(signing_time time, std::uint64_t duration) {
  const std::uint64_t left = units(max_signing_time) - units(time);
  return signing_time{units(time) + std::min(left, duration)};
}

[[nodiscard]] constexpr signing_time load_signing_time(std::span<const std::byte, signing_time_size> bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;)
    value = value << 8U | std::to_integer<std::uint64_t>(bytes[i]);
  return signing_time{value};
}

constexpr void store_signing_time(std::span<std::byte, signing_time_size> to, signing_time time) {
  for (std::size_t i = 0; i < to.size(); ++i)
    to[i] = static_cast<std::byte>(units(time) >> (8U * i));
}

} // namespace godwit::io::mavlink

struct evp_md_st;
struct evp_md_ctx_st;

namespace godwit::io::mavlink {

inline constexpr std::size_t signature_hash_size = 6;
using signature_hash = std::array<std::byte, signature_hash_size>;

// Which of the sender's links a frame went out on: the sender's own numbering.
enum class link_id : std::uint8_t {};

struct signature_block {
  link_id link{};
  signing_time time{};
  signature_hash hash{};
};

[[nodiscard]] std::array<std::byte, signature_size> store(const signature_block& block);
// Of a signed frame only.
[[nodiscard]] signature_block signature_of(const frame_view& frame);

class frame_hasher {
public:
  explicit frame_hasher(secret_key key);
  ~frame_hasher();
  frame_hasher(const frame_hasher&) = delete;
  frame_hasher& operator=(const frame_hasher&) = delete;
  frame_hasher(frame_hasher&&) noexcept;
  frame_hasher& operator=(frame_hasher&&) noexcept;

  // FRAME from FD to the checksum.
  [[nodiscard]] signature_hash hash_of(byte_view frame, link_id link, signing_time time);
  // True if the hash in the signed FRAME is the right one. Takes as long when it is not.
  [[nodiscard]] bool is_right(const frame_view& frame);

  [[nodiscard]] const secret_key& key() const { return key_; }

private:
  struct free_digest {
    void operator()(evp_md_st* digest) const;
  };
  struct free_context {
    void operator()(evp_md_ctx_st* context) const;
  };

  secret_key key_;
  std::unique_ptr<evp_md_st, free_digest> sha256_;
  std::unique_ptr<evp_md_ctx_st, free_context> context_;
};

} // namespace godwit::io::mavlink
