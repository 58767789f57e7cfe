#include "io/http/server/response_head.hpp"

#include <algorithm>
#include <array>
#include <iterator>

namespace godwit::io::http {

namespace {

struct phrase_row {
  unsigned status;
  std::string_view phrase;
};

constexpr std::array phrases{
    phrase_row{101, "Switching Protocols"},
    phrase_row{200, "OK"},
    phrase_row{201, "Created"},
    phrase_row{204, "No Content"},
    phrase_row{303, "See Other"},
    phrase_row{304, "Not Modified"},
    phrase_row{400, "Bad Request"},
    phrase_row{401, "Unauthorized"},
    phrase_row{403, "Forbidden"},
    phrase_row{404, "Not Found"},
    phrase_row{405, "Method Not Allowed"},
    phrase_row{408, "Request Timeout"},
    phrase_row{409, "Conflict"},
    phrase_row{410, "Gone"},
    phrase_row{413, "Content Too Large"},
    phrase_row{414, "URI Too Long"},
    phrase_row{421, "Misdirected Request"},
    phrase_row{422, "Unprocessable Content"},
    phrase_row{426, "Upgrade Required"},
    phrase_row{429, "Too Many Requests"},
    phrase_row{431, "Request Header Fields Too Large"},
    phrase_row{500, "Internal Server Error"},
    phrase_row{502, "Bad Gateway"},
    phrase_row{503, "Service Unavailable"},
    phrase_row{504, "Gateway Timeout"},
};

void append_line(std::string& to, std::string_view name, std::string_view value) {
  const auto is_allowed = [](char c) { return (static_cast<unsigned char>(c) >= ' ' && c != '\x7f') || c == '\t'; };
  for (const auto part : {name, std::string_view(": "), value})
    std::ranges::transform(part, std::back_inserter(to), [&](char c) { return is_allowed(c) ? c : '?'; });
  to += "\r\n";
}

} // namespace

std::string_view reason_phrase(unsigned status) {
  const auto* const found = std::ranges::find(phrases, status, &phrase_row::status);
  return found == phrases.end() ? std::string_view() : found->phrase;
}

bool has_no_body(unsigned status) { return status < 200 || status == 204 || status == 304; }

std::string response_head(const server_response& what, std::optional<std::uint64_t> body_bytes, bool is_last) {
  std::string head = "HTTP/1.1 " + std::to_string(what.status) + " " + std::string(reason_phrase(what.status)) + "\r\n";
  if (!what.content_type.empty() && !has_no_body(what.status))
    append_line(head, "Content-Type", what.content_type);
  if (body_bytes && !has_no_body(what.status))
    append_line(head, "Content-Length", std::to_string(*body_bytes));
  for (const auto& [name, value] : what.headers)
    append_line(head, name, value);
  if (is_last)
    append_line(head, "Connection", "close");
  return head + "\r\n";
}

server_response problem_response(unsigned status, std::string_view detail) {
  server_response made{.status = status, .content_type = std::string(problem_type), .headers = {}};
  made.body.append(R"({"type":"about:blank","title":")")
      .append(reason_phrase(status))
      .append(R"(","status":)")
      .append(std::to_string(status))
      .append(R"(,"detail":")")
      .append(detail)
      .append(R"("})");
  return made;
}

} // namespace godwit::io::http
