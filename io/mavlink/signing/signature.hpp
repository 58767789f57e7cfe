// The 13 bytes that end a signed frame, and the hash in them.
//
//   link id 1 | timestamp 6, little-endian | first 6 bytes of SHA-256(key, frame from FD to its checksum, link id,
//   timestamp)
//
// The hash object keeps its working memory, because making one for each frame costs more than the hash. Thread: one at
// a time. Source: the MAVLink guide, "Message Signing"; FIPS 180-4.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "io/mavlink/frame.hpp"
#include "io/mavlink/signing/secret_key.hpp"
#include "io/mavlink/signing/signing_time.hpp"

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
