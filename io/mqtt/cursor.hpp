// Reads the fields of a packet one after the other. What is not there makes it false, and gives 0. Thread: pure.
// Source: MQTT Version 5.0 (OASIS), 1.5.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace godwit::io::mqtt {

// The texts of MQTT: well-formed UTF-8 without U+0000. Thread: pure.
// Source: MQTT Version 5.0 (OASIS), 1.5.4; RFC 3629, 4.
[[nodiscard]] bool is_mqtt_text(std::string_view text);

class cursor {
public:
  explicit cursor(std::string_view bytes) : rest_(bytes) {}

  [[nodiscard]] bool is_sound() const { return is_sound_; }
  [[nodiscard]] bool is_at_end() const { return rest_.empty(); }
  [[nodiscard]] std::size_t left() const { return rest_.size(); }

  // Big-endian, of BYTES bytes.
  [[nodiscard]] std::uint32_t number(unsigned bytes) {
    std::uint32_t result = 0;
    for (const char each : taken(bytes))
      result = result << 8U | static_cast<std::uint8_t>(each);
    return result;
  }
  // A length in 1 to 4 bytes of 7 bits, in as few as possible.
  [[nodiscard]] std::size_t length() {
    std::size_t result = 0;
    for (unsigned n = 0; n < max_length_bytes; ++n) {
      const auto byte = number(1);
      result |= static_cast<std::size_t>(byte & 0x7FU) << 7U * n;
      if ((byte & 0x80U) == 0) {
        is_sound_ &= n == 0 || byte != 0;
        return result;
      }
    }
    is_sound_ = false;
    return 0;
  }
  void skip_text() {
    const auto size = number(2);
    is_sound_ &= is_mqtt_text(taken(size));
  }

private:
  static constexpr unsigned max_length_bytes = 4;

  [[nodiscard]] std::string_view taken(std::size_t size) {
    if (size > rest_.size() || !is_sound_) {
      is_sound_ = false;
      rest_ = {};
      return {};
    }
    const auto result = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return result;
  }

  std::string_view rest_;
  bool is_sound_ = true;
};

} // namespace godwit::io::mqtt
