#include "io/http/message.hpp"

#include <algorithm>

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

} // namespace godwit::io::http
