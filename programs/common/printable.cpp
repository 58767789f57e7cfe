#include "programs/common/printable.hpp"

#include <algorithm>

namespace godwit::programs {
namespace {

constexpr unsigned char delete_character = 0x7F;

// What does something to the text around it, and is more than one byte in UTF-8; RANGE: from its first to its last
// character, which differ in their last byte.
struct range {
  std::string_view first;
  unsigned char last;
};
constexpr range active[] = {
    {"\xC2\x80", 0x9F},     // C1
    {"\xD8\x9C", 0x9C},     // Arabic letter mark
    {"\xE2\x80\x8E", 0x8F}, // left-to-right mark, right-to-left mark
    {"\xE2\x80\xA8", 0xAE}, // line and paragraph separator; embeddings and overrides
    {"\xE2\x81\xA6", 0xA9}, // isolates
};

// How many bytes of such a character TEXT begins with; none: 0.
std::size_t active_bytes(std::string_view text) {
  const auto* const found = std::ranges::find_if(active, [&](const range& each) {
    const auto size = each.first.size();
    if (text.size() < size || text.substr(0, size - 1) != each.first.substr(0, size - 1))
      return false;
    const auto last = static_cast<unsigned char>(text[size - 1]);
    return last >= static_cast<unsigned char>(each.first.back()) && last <= each.last;
  });
  if (found != std::end(active))
    return found->first.size();
  const auto byte = static_cast<unsigned char>(text.front());
  return (byte < 0x20 && text.front() != '\t') || byte == delete_character ? 1 : 0;
}

void escape(std::string& to, std::string_view bytes) {
  constexpr std::string_view digits = "0123456789abcdef";
  for (const char each : bytes) {
    const auto byte = static_cast<unsigned char>(each);
    to += "\\x";
    to += digits[byte >> 4U];
    to += digits[byte & 15U];
  }
}

} // namespace

std::string printable(std::string_view text, std::string_view after_line_end) {
  std::string result;
  for (auto line = text.substr(0, text.find('\n'));; line = text.substr(0, text.find('\n'))) {
    result += one_line(line);
    if (line.size() == text.size())
      return result;
    result.append("\n").append(after_line_end);
    text.remove_prefix(line.size() + 1);
  }
}

std::string one_line(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const auto size = active_bytes(text);
    if (size != 0)
      escape(result, text.substr(0, size));
    else
      result += text.front();
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return result;
}

nlohmann::json printable_strings(const nlohmann::json& value) {
  if (value.is_string())
    return printable(value.get_ref<const std::string&>());
  auto result = value;
  if (value.is_object()) {
    result = nlohmann::json::object();
    for (const auto& [name, each] : value.items())
      result[printable(name)] = printable_strings(each);
  } else if (value.is_array()) {
    std::ranges::transform(value, result.begin(), printable_strings);
  }
  return result;
}

} // namespace godwit::programs
