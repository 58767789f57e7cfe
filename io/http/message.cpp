#include "io/http/message.hpp"

#include <algorithm>
#include <string_view>

#include "io/text.hpp"

namespace godwit::io::http {

namespace {

// Of ASCII only: the locale of the process must not change what a header is.
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

} // namespace

bool equals_ignoring_case(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) { return lower(x) == lower(y); });
}

std::string_view find_header(const std::vector<header>& all, std::string_view name) {
  const auto found = std::ranges::find_if(all, [&](const auto& h) { return equals_ignoring_case(h.name, name); });
  return found == all.end() ? std::string_view{} : std::string_view(found->value);
}

bool may_repeat(const request& asked) { return asked.method != method::post || !asked.idempotency_key.empty(); }

std::string_view method_text(method value) {
  switch (value) {
  case method::post:
    return "POST";
  case method::put:
    return "PUT";
  case method::remove:
    return "DELETE";
  default:
    return "GET";
  }
}

namespace {

constexpr std::string_view blanks = " \t";

std::string_view unquoted(std::string_view text) {
  return text.size() >= 2 && text.front() == '"' && text.back() == '"' ? text.substr(1, text.size() - 2) : text;
}

bool is_utf8(std::string_view charset) {
  return equals_ignoring_case(charset, "utf-8") || equals_ignoring_case(charset, "utf8") ||
         equals_ignoring_case(charset, "us-ascii");
}

// A semicolon in a quoted value ends the parameter too early; what is left of it is then no character set.
bool charset_is_read(std::string_view content_type) {
  for (auto at = content_type.find(';'); at != std::string_view::npos;) {
    const auto end = content_type.find(';', at + 1);
    const auto parameter =
        trimmed(content_type.substr(at + 1, end == std::string_view::npos ? end : end - at - 1), blanks);
    const auto equals = parameter.find('=');
    if (equals != std::string_view::npos && equals_ignoring_case(parameter.substr(0, equals), "charset") &&
        !is_utf8(unquoted(parameter.substr(equals + 1))))
      return false;
    at = end;
  }
  return true;
}

} // namespace

std::string_view media_type(std::string_view content_type) {
  const auto type = trimmed(content_type.substr(0, content_type.find(';')), blanks);
  return std::ranges::count(type, '/') == 1 ? type : std::string_view{};
}

bool has_content_type(std::string_view content_type, std::string_view expected) {
  const auto type = media_type(content_type);
  return !type.empty() && equals_ignoring_case(type, media_type(expected)) && charset_is_read(content_type);
}

bool is_json(std::string_view content_type) {
  constexpr std::string_view suffix = "+json";
  const auto type = media_type(content_type);
  const bool is_kind =
      type.size() > suffix.size() && equals_ignoring_case(type.substr(type.size() - suffix.size()), suffix);
  return (is_kind && charset_is_read(content_type)) || has_content_type(content_type, "application/json");
}

} // namespace godwit::io::http
