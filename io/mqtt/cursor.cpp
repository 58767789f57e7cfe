#include "io/mqtt/cursor.hpp"

#include <cstddef>
#include <cstdint>

namespace godwit::io::mqtt {

namespace {

struct lead {
  std::size_t followers;
  std::uint32_t bits;
  std::uint32_t smallest; // what fewer bytes can say is ill-formed
};

constexpr std::uint32_t largest_code_point = 0x10FFFF;
constexpr std::uint32_t first_surrogate = 0xD800;
constexpr std::uint32_t last_surrogate = 0xDFFF;

// Followers of 4: no lead at all.
lead lead_of(std::uint8_t byte) {
  if (byte < 0x80U)
    return {0, byte, 1};
  if ((byte & 0xE0U) == 0xC0U)
    return {1, byte & 0x1FU, 0x80};
  if ((byte & 0xF0U) == 0xE0U)
    return {2, byte & 0x0FU, 0x800};
  if ((byte & 0xF8U) == 0xF0U)
    return {3, byte & 0x07U, 0x10000};
  return {4, 0, 0};
}

} // namespace

bool is_mqtt_text(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const auto first = lead_of(static_cast<std::uint8_t>(text[at]));
    if (first.followers > 3 || text.size() - at <= first.followers)
      return false;
    auto code_point = first.bits;
    for (std::size_t n = 1; n <= first.followers; ++n) {
      const auto next = static_cast<std::uint8_t>(text[at + n]);
      if ((next & 0xC0U) != 0x80U)
        return false;
      code_point = code_point << 6U | (next & 0x3FU);
    }
    if (code_point < first.smallest || code_point > largest_code_point ||
        (code_point >= first_surrogate && code_point <= last_surrogate))
      return false;
    at += first.followers + 1;
  }
  return true;
}

} // namespace godwit::io::mqtt
