#include "io/mavlink/crc.hpp"

#include <array>
#include <cstddef>
#include <cstring>
#include <utility>

namespace godwit::io::mavlink {

namespace {

constexpr std::size_t step = 16; // bytes

// tables[k][b] is what byte b adds to the checksum when k bytes follow it in its step. A checksum is linear, so the
// sixteen bytes of a step are looked up independently of each other; only the two that the old checksum touches wait.
constexpr auto tables = [] {
  std::array<std::array<std::uint16_t, 256>, step> made{};
  for (unsigned byte = 0; byte < 256; ++byte)
    made[0][byte] = crc_of_byte(0, static_cast<std::uint8_t>(byte));
  for (std::size_t k = 1; k < step; ++k)
    for (unsigned byte = 0; byte < 256; ++byte)
      made[k][byte] = static_cast<std::uint16_t>((made[k - 1][byte] >> 8U) ^ made[0][made[k - 1][byte] & 0xFFU]);
  return made;
}();

std::uint16_t advance(std::uint16_t crc, std::uint8_t byte) {
  return static_cast<std::uint16_t>((crc >> 8U) ^ tables[0][(crc ^ byte) & 0xFFU]);
}

// What the bytes of WORD add when FOLLOWING bytes stand after them in the step.
template <std::size_t following, class Word>
unsigned lookup(Word word) {
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    return (unsigned{tables[following + sizeof(Word) - 1 - I][(word >> (8 * I)) & 0xFFU]} ^ ...);
  }
  (std::make_index_sequence<sizeof(Word)>{});
}

template <class Word>
Word load(const std::byte* from) {
  Word word = 0;
  std::memcpy(&word, from, sizeof word);
  return word;
}

} // namespace

// Steps of sixteen bytes, and the rest in halves: each of them waits for the one before it, so few are better.
std::uint16_t crc_of(byte_view bytes, std::uint16_t crc) {
  const std::byte* at = bytes.data();
  std::size_t left = bytes.size();
  unsigned sum = crc;
  for (; left >= step; left -= step, at += step)
    sum = lookup<8>(load<std::uint64_t>(at) ^ sum) ^ lookup<0>(load<std::uint64_t>(at + 8));
  if ((left & 8U) != 0) {
    sum = lookup<0>(load<std::uint64_t>(at) ^ sum);
    at += 8;
  }
  if ((left & 4U) != 0) {
    sum = lookup<0>(load<std::uint32_t>(at) ^ sum);
    at += 4;
  }
  for (left &= 3U; left != 0; --left, ++at)
    sum = advance(static_cast<std::uint16_t>(sum), std::to_integer<std::uint8_t>(*at));
  return static_cast<std::uint16_t>(sum);
}

std::uint16_t frame_crc(byte_view after_magic, std::uint8_t crc_extra) {
  return advance(crc_of(after_magic), crc_extra);
}

} // namespace godwit::io::mavlink
