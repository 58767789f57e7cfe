#include "io/mavlink/signing/secret_key.hpp"

#include <algorithm>

#include <openssl/crypto.h>

namespace godwit::io::mavlink {

void wipe(std::span<std::byte> bytes) { OPENSSL_cleanse(bytes.data(), bytes.size()); }

secret_key::secret_key(std::span<const std::byte, secret_key_size> bytes) { std::ranges::copy(bytes, bytes_.begin()); }

secret_key::secret_key(secret_key&& other) noexcept : bytes_(other.bytes_) { wipe(other.bytes_); }

secret_key& secret_key::operator=(secret_key&& other) noexcept {
  if (this != &other) {
    bytes_ = other.bytes_;
    wipe(other.bytes_);
  }
  return *this;
}

bool secret_key::is_all_zero() const {
  return std::ranges::all_of(bytes_, [](std::byte each) { return each == std::byte{0}; });
}

} // namespace godwit::io::mavlink
