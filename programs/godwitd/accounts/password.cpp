#include "programs/godwitd/accounts/password.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <span>
#include <vector>

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/rand.h>

#include "io/fields/hex_text.hpp"
#include "runtime/assert.hpp"

namespace godwit::accounts {

namespace {

constexpr std::size_t hash_bytes = 32;
constexpr std::size_t salt_bytes = 16;
constexpr std::uint64_t max_memory = std::uint64_t{64} * 1024 * 1024;

std::string scrypt(std::string_view password, const password_hash& how) {
  std::array<unsigned char, hash_bytes> out{};
  const bool is_done =
      EVP_PBE_scrypt(password.data(), password.size(), reinterpret_cast<const unsigned char*>(how.salt.data()),
                     how.salt.size(), how.n, how.r, how.p, max_memory * 2, out.data(), out.size()) == 1;
  GODWIT_ASSERT(is_done, "a sane cost is one that scrypt takes");
  auto result = io::hex_of(std::as_bytes(std::span(out)));
  OPENSSL_cleanse(out.data(), out.size());
  return result;
}

bool is_hex(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

} // namespace

bool is_sane(const password_hash& kept) {
  const auto memory = 128 * kept.n * kept.r; // RFC 7914, 2
  return kept.n >= 2 && kept.n <= (1U << 20U) && std::has_single_bit(kept.n) && kept.r >= 1 && kept.r <= 32 &&
         kept.p >= 1 && kept.p <= 16 && memory <= max_memory && kept.salt.size() == 2 * salt_bytes &&
         kept.hash.size() == 2 * hash_bytes && is_hex(kept.salt) && is_hex(kept.hash);
}

password_hash hash_password(std::string_view password, const password_hash& like) {
  auto result = like;
  result.salt = random_hex(salt_bytes);
  result.hash = scrypt(password, result);
  return result;
}

bool is_password(std::string_view password, const password_hash& kept) {
  if (!is_sane(kept))
    return false;
  const auto found = scrypt(password, kept);
  return CRYPTO_memcmp(found.data(), kept.hash.data(), found.size()) == 0;
}

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
