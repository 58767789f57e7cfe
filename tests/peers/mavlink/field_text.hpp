// The text of a field in a description: the same for the same value, whoever writes it (field_text.mjs is the other).
//
//   whole number        decimal digits
//   float               its 32 bits as eight hexadecimal digits; "nan" for every NaN, as JavaScript keeps no others
//   apart array               its elements, a space between two array of char       two hexadecimal digits a byte, up
//   to the first NUL or the end of the room
//
// Thread: pure.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

#include "io/mavlink/layout.hpp"
#include "tests/peers/mavlink/described_frame.hpp"

namespace godwit::io::mavlink::peers {

// The lowest DIGITS hexadecimal digits of VALUE.
[[nodiscard]] inline std::string hex_text(std::uint32_t value, unsigned digits) {
  std::string result;
  for (unsigned i = digits; i-- > 0;)
    result += "0123456789abcdef"[value >> (4U * i) & 0xFU];
  return result;
}

template <class V>
[[nodiscard]] std::string text_of(const V& value) {
  if constexpr (is_char_array<V>::value) {
    std::string result;
    for (const char each : text_in(value))
      result += hex_text(static_cast<unsigned char>(each), 2);
    return result;
  } else if constexpr (is_std_array<V>::value) {
    std::string result;
    for (const auto& each : value)
      result += (result.empty() ? "" : " ") + text_of(each);
    return result;
  } else if constexpr (std::is_same_v<V, float>) {
    return std::isnan(value) ? "nan" : hex_text(std::bit_cast<std::uint32_t>(value), 8);
  } else {
    static_assert(std::is_integral_v<V>, "no message has such a field so far");
    return std::to_string(value);
  }
}

// All fields, the secret ones too: the only key that comes here is the one of the test.
template <message M>
[[nodiscard]] texts texts_of(const M& message) {
  texts result;
  for_each_field<M>(
      [&](const auto& entry) { result.emplace(std::string(entry.name), text_of(message.*entry.member)); });
  return result;
}

} // namespace godwit::io::mavlink::peers
