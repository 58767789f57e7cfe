// What the tests of the codec share: bytes from hexadecimal text and from files of tests/data, and random messages.
#pragma once

#include <array>
#include <cstring>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "io/mavlink/codec.hpp"
#include "io/mavlink/messages.hpp"
#include "io/mavlink/scanner.hpp"

namespace godwit::io::mavlink {

using byte_buffer = std::vector<std::byte>;

[[nodiscard]] byte_buffer from_hex(std::string_view hex);
[[nodiscard]] std::string to_hex(byte_view bytes);

// NAME is relative to tests/data.
[[nodiscard]] byte_buffer test_data(const std::string& name);

void append(byte_buffer& to, byte_view bytes);

// The frames that a scanner finds in BYTES given at once.
[[nodiscard]] std::vector<byte_buffer> frames_in(byte_view bytes);

// A message as the bits of its fields, by which NaN equals itself.
template <message M>
[[nodiscard]] std::array<std::byte, layout<M>::full_length> bits_of(const M& message) {
  std::array<std::byte, layout<M>::full_length> bits;
  write_fields(message, bits.data());
  return bits;
}

// An M with any bits in its fields, each field zero one time in three: the end of a payload is often cut off then.
template <message M>
[[nodiscard]] M random_message(std::mt19937_64& random) {
  M result;
  for_each_field<M>([&](const auto& entry) {
    auto& value = result.*entry.member;
    std::array<std::byte, sizeof value> bits{};
    if (random() % 3 != 0)
      for (auto& each : bits)
        each = static_cast<std::byte>(random());
    std::memcpy(&value, bits.data(), sizeof value);
  });
  return result;
}

// COUNT frames of messages that are sent often, numbered from 0.
[[nodiscard]] std::vector<byte_buffer> some_frames(std::size_t count, std::mt19937_64& random);

} // namespace godwit::io::mavlink
