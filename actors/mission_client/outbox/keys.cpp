#include "actors/mission_client/outbox/keys.hpp"

namespace godwit::mission_client {

namespace {

constexpr std::string_view hex_digits = "0123456789abcdef";

// The finisher of MurmurHash3: each bit of the input changes half of the output's.
std::uint64_t mix(std::uint64_t bits) {
  bits = (bits ^ (bits >> 33U)) * 0xff51afd7ed558ccdULL;
  bits = (bits ^ (bits >> 33U)) * 0xc4ceb9fe1a85ec53ULL;
  return bits ^ (bits >> 33U);
}

std::string uuid_text(std::uint64_t high, std::uint64_t low, std::uint64_t version) {
  high = (high & ~0xf000ULL) | version << 12U;
  low = (low & ~(3ULL << 62U)) | 2ULL << 62U; // the variant of the RFC
  std::string text;
  for (unsigned digit = 0; digit < 32; ++digit) {
    if (digit == 8 || digit == 12 || digit == 16 || digit == 20)
      text += '-';
    const auto half = digit < 16 ? high : low;
    text += hex_digits[(half >> (60U - 4U * (digit % 16U))) & 15U];
  }
  return text;
}

} // namespace

std::uint64_t hash_of(std::string_view text, std::uint64_t start) {
  auto result = mix(start + 0x9e3779b97f4a7c15ULL);
  for (const auto character : text)
    result = mix(result * 31U + static_cast<unsigned char>(character));
  return mix(result ^ text.size());
}

std::string fresh_key(runtime::random_source& random) {
  const auto high = random.next();
  return uuid_text(high, random.next(), 4);
}

std::string derived_key(const std::vector<std::string_view>& parts) {
  std::uint64_t high = 0x676f6477; // any start; two different ones give two independent halves
  std::uint64_t low = 0x69740001;
  for (const auto& each : parts) {
    high = hash_of(each, high);
    low = hash_of(each, low);
  }
  return uuid_text(high, low, 8);
}

} // namespace godwit::mission_client
