#include "io/mavlink/signing/signature.hpp"

#include <algorithm>
#include <cassert>

#include <openssl/crypto.h>
#include <openssl/evp.h>

namespace godwit::io::mavlink {

namespace {

constexpr std::size_t time_at = 1;
constexpr std::size_t hash_at = time_at + signing_time_size;
static_assert(hash_at + signature_hash_size == signature_size);

} // namespace

std::array<std::byte, signature_size> store(const signature_block& block) {
  std::array<std::byte, signature_size> bytes{};
  const std::span all(bytes);
  bytes[0] = static_cast<std::byte>(block.link);
  store_signing_time(all.subspan<time_at, signing_time_size>(), block.time);
  std::ranges::copy(block.hash, bytes.begin() + hash_at);
  return bytes;
}

signature_block signature_of(const frame_view& frame) {
  assert(frame.is_signed());
  const auto bytes = frame.signature().first<signature_size>();
  signature_block block{
      static_cast<link_id>(bytes[0]), load_signing_time(bytes.subspan<time_at, signing_time_size>()), {}};
  std::ranges::copy(bytes.subspan<hash_at>(), block.hash.begin());
  return block;
}

void frame_hasher::free_digest::operator()(evp_md_st* digest) const { EVP_MD_free(digest); }
void frame_hasher::free_context::operator()(evp_md_ctx_st* context) const { EVP_MD_CTX_free(context); }

// A libcrypto without SHA-256, or no memory for a few hundred bytes at the start, is nothing that one can go on with.
frame_hasher::frame_hasher(secret_key key)
    : key_(std::move(key)), sha256_(EVP_MD_fetch(nullptr, "SHA256", nullptr)), context_(EVP_MD_CTX_new()) {
  assert(sha256_ != nullptr && context_ != nullptr);
}

frame_hasher::~frame_hasher() = default;
frame_hasher::frame_hasher(frame_hasher&&) noexcept = default;
frame_hasher& frame_hasher::operator=(frame_hasher&&) noexcept = default;

signature_hash frame_hasher::hash_of(byte_view frame, link_id link, signing_time time) {
  std::array<std::byte, hash_at> stamp{static_cast<std::byte>(link)};
  store_signing_time(std::span(stamp).subspan<time_at, signing_time_size>(), time);
  std::array<unsigned char, 32> digest;
  const bool done = EVP_DigestInit_ex2(context_.get(), sha256_.get(), nullptr) == 1 &&
                    EVP_DigestUpdate(context_.get(), key_.bytes().data(), secret_key_size) == 1 &&
                    EVP_DigestUpdate(context_.get(), frame.data(), frame.size()) == 1 &&
                    EVP_DigestUpdate(context_.get(), stamp.data(), stamp.size()) == 1 &&
                    EVP_DigestFinal_ex(context_.get(), digest.data(), nullptr) == 1;
  assert(done); // hashing in memory can not fail, and a signature out of unset bytes must never leave
  signature_hash hash;
  std::ranges::copy_n(std::as_bytes(std::span(digest)).begin(), signature_hash_size, hash.begin());
  return hash;
}

bool frame_hasher::is_right(const frame_view& frame) {
  const signature_block claimed = signature_of(frame);
  const auto covered = frame.bytes().first(frame.size() - signature_size);
  const signature_hash right = hash_of(covered, claimed.link, claimed.time);
  return CRYPTO_memcmp(right.data(), claimed.hash.data(), signature_hash_size) == 0;
}

} // namespace godwit::io::mavlink
