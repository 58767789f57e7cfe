#include "programs/godwitd/accounts/token.hpp"

#include <array>
#include <span>
#include <vector>

#include <openssl/evp.h>
#include <openssl/rand.h>

#include "io/fields/hex_text.hpp"
#include "runtime/assert.hpp"

namespace godwit::accounts {
namespace {

void fill(std::span<unsigned char> to) {
  GODWIT_ASSERT(RAND_bytes(to.data(), static_cast<int>(to.size())) == 1, "the system has randomness");
}

} // namespace

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
  return io::hex_of(std::as_bytes(std::span(digest)));
}

std::string random_hex(std::size_t bytes) {
  std::vector<unsigned char> result(bytes);
  fill(result);
  return io::hex_of(std::as_bytes(std::span(result)));
}

} // namespace godwit::accounts
