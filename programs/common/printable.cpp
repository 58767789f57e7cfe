#include "programs/common/printable.hpp"

namespace godwit::programs {
namespace {

constexpr unsigned char delete_character = 0x7F;
constexpr unsigned char lead_of_c1 = 0xC2;

void escape(std::string& to, unsigned char byte) {
  constexpr std::string_view digits = "0123456789abcdef";
  to += "\\x";
  to += digits[byte >> 4U];
  to += digits[byte & 15U];
}

bool is_c1(unsigned char lead, unsigned char next) { return lead == lead_of_c1 && next >= 0x80 && next <= 0x9F; }

} // namespace

std::string printable(std::string_view text, std::string_view after_line_end) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (text[i] == '\n') {
      result += '\n';
      result += after_line_end;
    } else if ((byte < 0x20 && text[i] != '\t') || byte == delete_character) {
      escape(result, byte);
    } else if (i + 1 < text.size() && is_c1(byte, static_cast<unsigned char>(text[i + 1]))) {
      escape(result, byte);
      escape(result, static_cast<unsigned char>(text[++i]));
    } else {
      result += text[i];
    }
  }
  return result;
}

} // namespace godwit::programs
