// Values for all fields of a message: a few patterns that reach the ends of every type, and random ones.
//
// A pattern gives the bytes of each number. What it means depends on the type: {00 .. 00, 80} is the lowest whole
// number and -0 as a float, {FF .. FF, 7F} the highest and a NaN. field_values.mjs has the same ones. Thread: pure.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <random>

#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink::peers {

// Little-endian: a number of one byte has only the last.
struct byte_pattern {
  std::byte lower{};
  std::byte last_but_one{};
  std::byte last{};
};

inline constexpr std::array byte_patterns{
    byte_pattern{},                                                  // zero: the payload is cut to one byte
    byte_pattern{std::byte{0xFF}, std::byte{0xFF}, std::byte{0xFF}}, // highest unsigned, -1, NaN
    byte_pattern{std::byte{0x00}, std::byte{0x00}, std::byte{0x80}}, // lowest signed, -0
    byte_pattern{std::byte{0xFF}, std::byte{0xFF}, std::byte{0x7F}}, // highest signed
    byte_pattern{std::byte{0xFF}, std::byte{0x7F}, std::byte{0x7F}}, // highest float
    byte_pattern{std::byte{0x00}, std::byte{0x80}, std::byte{0x7F}}, // infinity
    byte_pattern{std::byte{0x00}, std::byte{0x80}, std::byte{0xFF}}, // -infinity
};

template <class V>
void fill(V& value, const byte_pattern& pattern) {
  std::array<std::byte, sizeof value> bytes;
  bytes.fill(pattern.lower);
  if constexpr (sizeof value > 1)
    bytes[sizeof value - 2] = pattern.last_but_one;
  bytes[sizeof value - 1] = pattern.last;
  std::memcpy(&value, bytes.data(), sizeof value);
}

template <class V, std::size_t N>
void fill(std::array<V, N>& values, const byte_pattern& pattern) {
  for (auto& each : values)
    fill(each, pattern);
}

template <message M>
[[nodiscard]] M patterned(const byte_pattern& pattern) {
  M result;
  for_each_field<M>([&](const auto& entry) { fill(result.*entry.member, pattern); });
  return result;
}

template <class V>
void randomise(V& value, std::mt19937_64& random) {
  std::array<std::byte, sizeof value> bytes;
  for (auto& each : bytes)
    each = static_cast<std::byte>(random());
  std::memcpy(&value, bytes.data(), sizeof value);
}

// A text of any length. Half of them have something after their NUL, which nobody may read as part of the text.
template <std::size_t N>
void randomise(std::array<char, N>& text, std::mt19937_64& random) {
  const auto length = static_cast<std::size_t>(random() % (N + 1));
  const bool has_rest = random() % 2 == 0;
  for (std::size_t i = 0; i < N; ++i)
    text[i] = i < length || (i > length && has_rest) ? static_cast<char>(1 + random() % 255) : '\0';
}

// Any bits. One field in three is zero, so that ends of all lengths are cut off.
template <message M>
[[nodiscard]] M randomised(std::mt19937_64& random) {
  auto result = patterned<M>(byte_patterns[0]);
  for_each_field<M>([&](const auto& entry) {
    if (random() % 3 != 0)
      randomise(result.*entry.member, random);
  });
  return result;
}

} // namespace godwit::io::mavlink::peers
