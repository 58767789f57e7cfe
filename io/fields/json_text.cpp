#include "io/fields/json_text.hpp"

#include <charconv>
#include <cmath>

namespace godwit::io {

namespace {

constexpr std::string_view replacement_character = "\xEF\xBF\xBD";

// Length of the well-formed UTF-8 sequence at the start of TEXT, 0 if there is none (RFC 3629: no overlong forms, no
// surrogates).
std::size_t utf8_sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const auto continues = [&](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
  const auto lead = byte(0);
  if (lead < 0x80)
    return 1;
  if (lead >= 0xC2 && lead <= 0xDF)
    return continues(1) ? 2 : 0;
  if (lead >= 0xE0 && lead <= 0xEF) {
    const bool second_ok = lead == 0xE0   ? byte(1) >= 0xA0 && byte(1) <= 0xBF
                           : lead == 0xED ? byte(1) >= 0x80 && byte(1) <= 0x9F
                                          : continues(1);
    return second_ok && continues(2) ? 3 : 0;
  }
  if (lead >= 0xF0 && lead <= 0xF4) {
    const bool second_ok = lead == 0xF0   ? byte(1) >= 0x90 && byte(1) <= 0xBF
                           : lead == 0xF4 ? byte(1) >= 0x80 && byte(1) <= 0x8F
                                          : continues(1);
    return second_ok && continues(2) && continues(3) ? 4 : 0;
  }
  return 0;
}

template <class N>
void append_number(std::string& out, N value) {
  char digits[32];
  out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

template <class N>
void append_floating(std::string& out, N value) {
  if (std::isfinite(value))
    append_number(out, value);
  else
    out += "null";
}

void append_escaped_control(std::string& out, unsigned char c) {
  constexpr char hex[] = "0123456789abcdef";
  switch (c) {
  case '\n':
    out += "\\n";
    return;
  case '\r':
    out += "\\r";
    return;
  case '\t':
    out += "\\t";
    return;
  default:
    out += "\\u00";
    out += hex[c >> 4U];
    out += hex[c & 0xFU];
  }
}

} // namespace

void append_json_double(std::string& out, double value) { append_floating(out, value); }
void append_json_float(std::string& out, float value) { append_floating(out, value); }
void append_json_signed(std::string& out, std::int64_t value) { append_number(out, value); }
void append_json_unsigned(std::string& out, std::uint64_t value) { append_number(out, value); }

void append_json_name(std::string& out, std::string_view name) {
  if (out.back() != '{')
    out += ',';
  out += '"';
  out += name;
  out += "\":";
}

void append_json_string(std::string& out, std::string_view text) {
  out += '"';
  std::size_t plain_from = 0;
  std::size_t i = 0;
  while (i < text.size()) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c >= 0x20 && c < 0x80 && c != '"' && c != '\\') {
      ++i;
      continue;
    }
    const auto length = utf8_sequence_length(text.substr(i));
    if (c >= 0x80 && length > 1) {
      i += length;
      continue;
    }
    out.append(text, plain_from, i - plain_from);
    if (c < 0x20) {
      append_escaped_control(out, c);
    } else if (c >= 0x80) {
      out += replacement_character;
    } else {
      out += '\\';
      out += static_cast<char>(c);
    }
    plain_from = ++i;
  }
  out.append(text, plain_from, text.size() - plain_from);
  out += '"';
}

} // namespace godwit::io
