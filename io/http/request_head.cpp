#include "io/http/request_head.hpp"

#include <algorithm>
#include <array>

#include "io/http/content_coding.hpp"

namespace godwit::io::http {
namespace {

constexpr std::array<std::string_view, 10> written_by_us{
    "Host",           "Accept",       "Accept-Encoding", "Authorization",     "Connection",
    "Content-Length", "Content-Type", "Idempotency-Key", "Transfer-Encoding", "User-Agent"};

tl::unexpected<error> refused(std::string what) { return failure(errc::invalid_request, std::move(what)); }

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
}
bool is_value_character(char c) { return (c >= ' ' && c < '\x7f') || c == '\t'; }
bool is_target_character(char c) { return c > ' ' && c < '\x7f' && c != '#'; }

// What is written is the same, whether it is counted or kept: one list of the lines.
template <class Append>
void write_head(const request& asked, const destination& to, std::string_view token, Append append) {
  const auto line = [&](std::string_view name, std::string_view value) {
    append(name);
    append(": ");
    append(value);
    append("\r\n");
  };
  append(method_text(asked.method));
  append(" ");
  if (to.has_proxy && !to.base.is_tls)
    append(to.base.origin());
  append(to.base.path);
  append(asked.target);
  append(" HTTP/1.1\r\n");
  line("Host", to.base.host_header());
  line("Accept-Encoding", asked.accepts_compressed ? accepted_codings : "identity");
  line("User-Agent", "godwit");
  if (!asked.accept.empty())
    line("Accept", asked.accept);
  if (!token.empty()) {
    append("Authorization: Bearer ");
    append(token);
    append("\r\n");
  }
  if (!asked.idempotency_key.empty())
    line("Idempotency-Key", asked.idempotency_key);
  if (!asked.body.empty() && !asked.content_type.empty())
    line("Content-Type", asked.content_type);
  if (!asked.body.empty() || asked.method == method::post || asked.method == method::put)
    line("Content-Length", std::to_string(asked.body.size()));
  for (const auto& each : asked.headers)
    line(each.name, each.value);
  append("\r\n");
}

std::size_t size_of_head(const request& asked, const destination& to, std::string_view token) {
  std::size_t size = 0;
  write_head(asked, to, token, [&](std::string_view part) { size += part.size(); });
  return size;
}

result<void> check_headers(const request& asked) {
  const auto is_value = [](std::string_view text) { return std::ranges::all_of(text, is_value_character); };
  if (!is_value(asked.accept) || !is_value(asked.content_type) || !is_value(asked.idempotency_key))
    return refused("a header of the request has characters that a header can not have");
  for (const auto& each : asked.headers) {
    if (each.name.empty() || !std::ranges::all_of(each.name, is_name_character) || !is_value(each.value))
      return refused("a header of the request has characters that a header can not have");
    if (std::ranges::any_of(written_by_us, [&](auto name) { return equals_ignoring_case(name, each.name); }))
      return refused("the client writes the header " + each.name + " itself");
  }
  return {};
}

} // namespace

result<void> check_request(const request& asked, const destination& to) {
  if (!asked.target.starts_with('/') || asked.target.size() > max_target_bytes ||
      !std::ranges::all_of(asked.target, is_target_character))
    return refused("a target begins with a slash, is percent-encoded, and has at most " +
                   std::to_string(max_target_bytes) + " characters");
  if (asked.body.size() > max_request_body_bytes)
    return refused("the body has " + std::to_string(asked.body.size()) + " bytes, and may have " +
                   std::to_string(max_request_body_bytes) + ": send it in parts");
  if (auto checked_headers = check_headers(asked); !checked_headers)
    return checked_headers;
  if (size_of_head(asked, to, {}) > max_request_head_bytes)
    return refused("the headers of the request have more than " + std::to_string(max_request_head_bytes) + " bytes");
  return {};
}

secret_text request_head(const request& asked, const destination& to, std::string_view token) {
  secret_text head(size_of_head(asked, to, token));
  char* at = head.data();
  write_head(asked, to, token, [&](std::string_view part) { at = std::ranges::copy(part, at).out; });
  return head;
}

std::string connect_head(const destination& to) {
  const auto authority = to.base.authority();
  return "CONNECT " + authority + " HTTP/1.1\r\nHost: " + authority + "\r\nUser-Agent: godwit\r\n\r\n";
}

} // namespace godwit::io::http
