#include "actors/domain/uuid/uuid.hpp"

#include "runtime/assert.hpp"

namespace godwit::ids {

namespace {

constexpr std::size_t text_size = 36;
constexpr std::string_view hex_digits = "0123456789abcdef";

bool is_dash(std::size_t index) { return index == 8 || index == 13 || index == 18 || index == 23; }

bool is_hex_digit(char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); }

// Of a digit that was looked at before.
std::uint64_t value_of(char digit) { return static_cast<std::uint64_t>(digit <= '9' ? digit - '0' : digit - 'a' + 10); }

// The finisher of MurmurHash3: each bit of the input changes half of the output's.
std::uint64_t mix(std::uint64_t bits) {
  bits = (bits ^ (bits >> 33)) * 0xff51afd7ed558ccdU;
  bits = (bits ^ (bits >> 33)) * 0xc4ceb9fe1a85ec53U;
  return bits ^ (bits >> 33);
}

} // namespace

bool is_uuid(std::string_view text) {
  if (text.size() != text_size)
    return false;
  for (std::size_t i = 0; i < text_size; ++i)
    if (is_dash(i) ? text[i] != '-' : !is_hex_digit(text[i]))
      return false;
  return true;
}

uuid_bits bits_of(std::string_view uuid) {
  GODWIT_ASSERT(is_uuid(uuid), "only a UUID has the bits of one");
  uuid_bits bits{};
  std::size_t digit = 0;
  for (std::size_t i = 0; i < text_size; ++i) {
    if (is_dash(i))
      continue;
    auto& half = bits[digit++ / 16];
    half = (half << 4) | value_of(uuid[i]);
  }
  return bits;
}

std::string text_of(const uuid_bits& uuid) {
  std::string text;
  for (std::size_t digit = 0; digit < 32; ++digit) {
    if (is_dash(text.size()))
      text += '-';
    text += hex_digits[(uuid[digit / 16] >> (60 - 4 * (digit % 16))) & 15];
  }
  return text;
}

std::string derived_uuid(std::string_view first, std::string_view second) {
  std::uint64_t high = 0x676f6477; // any start; two different ones give two independent halves
  std::uint64_t low = 0x69740001;
  for (const auto& half : {bits_of(first), bits_of(second)})
    for (const auto bits : half) {
      high = mix(high * 31 + bits);
      low = mix((low ^ bits) + 0x9e3779b97f4a7c15U);
    }
  high = (high & ~std::uint64_t{0xf000}) | 0x8000;                    // version 8
  low = (low & ~(std::uint64_t{3} << 62)) | (std::uint64_t{2} << 62); // variant of the RFC
  return text_of({high, low});
}

} // namespace godwit::ids
