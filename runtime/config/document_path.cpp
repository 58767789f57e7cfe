#include "runtime/config/document_path.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace godwit::runtime {

namespace {

constexpr std::size_t longest_shown = 60; // bytes of a text in a message; the rest is three dots

bool is_plain(char character) {
  return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') ||
         (character >= '0' && character <= '9') || character == '_' || character == '-' || character == '$';
}

} // namespace

std::string readable_text(std::string_view text) {
  auto shown = std::string(text.substr(0, longest_shown));
  if (text.size() > longest_shown)
    shown += "...";
  // `replace`, because the cut may have gone through a character of several bytes.
  return nlohmann::json(shown).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string readable_key(std::string_view key) {
  if (!key.empty() && key.size() <= longest_shown && std::all_of(key.begin(), key.end(), is_plain))
    return std::string(key);
  return readable_text(key);
}

std::string path_to_key(std::string_view parent, std::string_view key) {
  return parent.empty() ? readable_key(key) : std::string(parent) + "." + readable_key(key);
}

std::string path_to_item(std::string_view parent, std::size_t index) {
  return std::string(parent) + "[" + std::to_string(index) + "]";
}

} // namespace godwit::runtime
