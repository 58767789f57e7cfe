#include "programs/common/printable.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <string_view>

namespace godwit::programs {

namespace {

constexpr unsigned char delete_character = 0x7F;

struct unseen {
  std::string_view first;
  std::string_view last; // of the same length
};

// In UTF-8, where what is greater stands after.
constexpr std::array<unseen, 9> not_seen{{
    {"\xc2\x80", "\xc2\x9f"},                 // C1
    {"\xc2\xad", "\xc2\xad"},                 // soft hyphen
    {"\xd8\x9c", "\xd8\x9c"},                 // Arabic letter mark
    {"\xe1\xa0\x8e", "\xe1\xa0\x8e"},         // Mongolian vowel separator
    {"\xe2\x80\x8b", "\xe2\x80\x8f"},         // of no width, joiners, marks of direction
    {"\xe2\x80\xa8", "\xe2\x80\xae"},         // separators of lines and paragraphs, embeddings, overrides
    {"\xe2\x81\xa0", "\xe2\x81\xaf"},         // joiners, isolates
    {"\xef\xbb\xbf", "\xef\xbb\xbf"},         // byte order mark
    {"\xf3\xa0\x80\x80", "\xf3\xa0\x81\xbf"}, // tags
}};

void escape(std::string& to, std::string_view bytes) {
  constexpr std::string_view digits = "0123456789abcdef";
  for (const char each : bytes) {
    const auto byte = static_cast<unsigned char>(each);
    to += "\\x";
    to += digits[byte >> 4U];
    to += digits[byte & 15U];
  }
}

// How many bytes at the beginning of TEXT are one character that is not to be seen; 0: they are another one.
std::size_t unseen_bytes(std::string_view text) {
  const auto byte = static_cast<unsigned char>(text.front());
  if (byte < 0x20 || byte == delete_character)
    return text.front() == '\t' ? 0 : 1;
  const auto* const found = std::ranges::find_if(not_seen, [&](const unseen& each) {
    const auto here = text.substr(0, each.first.size());
    return here.size() == each.first.size() && here >= each.first && here <= each.last;
  });
  return found == not_seen.end() ? 0 : found->first.size();
}

} // namespace

std::string printable(std::string_view text, std::string_view after_line_end) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const auto escaped = unseen_bytes(text);
    if (text.front() == '\n')
      result.append("\n").append(after_line_end);
    else if (escaped != 0)
      escape(result, text.substr(0, escaped));
    else
      result += text.front();
    text.remove_prefix(std::max<std::size_t>(1, escaped));
  }
  return result;
}

std::string one_line(std::string_view text) {
  std::string result;
  for (auto end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    result += printable(text.substr(0, end), "");
    escape(result, "\n");
    text.remove_prefix(end + 1);
  }
  return result + printable(text, "");
}

namespace {

constexpr const char* left_out = "(left out)";

bool means_a_secret(std::string name) {
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (name.ends_with("_file"))
    return false;
  static constexpr std::array<std::string_view, 6> words{"token", "password", "passwd", "secret", "credential", "auth"};
  return name == "key" || name.ends_with("_key") ||
         std::ranges::any_of(words, [&](std::string_view word) { return name.find(word) != name.npos; });
}

} // namespace

std::string address_without_secrets(const std::string& text) {
  const auto scheme = text.find("://");
  if (scheme == std::string::npos)
    return text;
  const auto host = scheme + 3;
  auto result = text;
  if (const auto query = result.find('?', host); query != std::string::npos)
    result.replace(query + 1, std::string::npos, left_out);
  const auto end = result.find_first_of("/?#", host);
  const auto user = result.rfind('@', end == std::string::npos ? end : end - 1);
  if (user != std::string::npos && user >= host)
    result.replace(host, user - host, left_out);
  return result;
}

nlohmann::json without_secrets(nlohmann::json document) {
  if (document.is_string())
    return address_without_secrets(document.get<std::string>());
  if (document.is_array())
    for (auto& each : document)
      each = without_secrets(std::move(each));
  if (document.is_object())
    for (auto& [name, value] : document.items())
      value =
          means_a_secret(name) && !value.is_boolean() ? nlohmann::json(left_out) : without_secrets(std::move(value));
  return document;
}

} // namespace godwit::programs
