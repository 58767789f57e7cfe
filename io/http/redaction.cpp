#include "io/http/redaction.hpp"

namespace godwit::io::http {
namespace {

void replace_all(std::string& text, std::string_view what) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + redacted.size()))
    text.replace(at, what.size(), redacted);
}

} // namespace

void redact(std::string& text, std::string_view token) {
  if (token.size() < min_redacted_bytes)
    return;
  replace_all(text, token);
  if (token.find('/') == std::string_view::npos)
    return;
  std::string escaped;
  for (const char each : token)
    escaped += each == '/' ? "\\/" : std::string(1, each);
  replace_all(text, escaped);
}

} // namespace godwit::io::http
