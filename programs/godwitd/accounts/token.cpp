#include "programs/godwitd/accounts/token.hpp"

#include <array>
#include <span>
#include <vector>

#include <openssl/evp.h>
#include <openssl/rand.h>

#include "runtime/assert.hpp"

namespace godwit::accounts {
namespace {

void fill(std::span<unsigned char> to) {
  GODWIT_ASSERT(RAND_bytes(to.data(), static_cast<int>(to.size())) == 1, "the system has randomness");
}

} // namespace

std::string hex_of(std::span<const unsigned char> bytes) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string result;
  for (const auto each : bytes) {
    result += digits[each >> 4U];
    result += digits[each & 15U];
  }
  return result;
}

io::http::secret_text new_token() {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  std::array<unsigned char, token_size> bytes{}; // six bits of each
  fill(bytes);
  io::http::secret_text result(token_size);
  for (std::size_t i = 0; i < token_size; ++i)
    result.data()[i] = letters[bytes[i] & 63U];
  OPENSSL_cleanse(bytes.data(), bytes.size());
  return result;
}

std::string hash_of_token(std::string_view token) {
  std::array<unsigned char, 32> digest{};
  unsigned size = 0;
  GODWIT_ASSERT(EVP_Digest(token.data(), token.size(), digest.data(), &size, EVP_sha256(), nullptr) == 1 &&
                    size == digest.size(),
                "SHA-256 is there");
  return hex_of(digest);
}

std::string random_hex(std::size_t bytes) {
  std::vector<unsigned char> result(bytes);
  fill(result);
  return hex_of(result);
}

} // namespace godwit::accounts
