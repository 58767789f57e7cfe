#include "programs/common/redaction.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace godwit::programs {

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
