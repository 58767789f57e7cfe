// The 32 bytes that both ends of a signed link share.
//
// Never printed, never copied: it is moved to where it is used, and the memory that it leaves is wiped. What it does
// not guard against is a core dump or somebody who reads our memory. Thread: one at a time.
#pragma once

#include <array>
#include <cstddef>
#include <iosfwd>
#include <span>

namespace godwit::io::mavlink {

inline constexpr std::size_t secret_key_size = 32;

// Overwrites BYTES in a way that the compiler does not optimise away.
void wipe(std::span<std::byte> bytes);

class secret_key {
public:
  // A copy of BYTES; to wipe those is for the caller.
  explicit secret_key(std::span<const std::byte, secret_key_size> bytes);
  secret_key(secret_key&& other) noexcept;
  secret_key& operator=(secret_key&& other) noexcept;
  secret_key(const secret_key&) = delete;
  secret_key& operator=(const secret_key&) = delete;
  ~secret_key() { wipe(bytes_); }

  // For the hash and for SETUP_SIGNING, and for nothing else.
  [[nodiscard]] std::span<const std::byte, secret_key_size> bytes() const { return bytes_; }

  // In SETUP_SIGNING a key of zeros means that signing is switched off, so it is no key.
  [[nodiscard]] bool is_all_zero() const;

  friend std::ostream& operator<<(std::ostream& out, const secret_key& key) = delete;

private:
  std::array<std::byte, secret_key_size> bytes_{};
};

} // namespace godwit::io::mavlink
