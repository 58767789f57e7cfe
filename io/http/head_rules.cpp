#include "io/http/head_rules.hpp"

#include "io/http/content_type.hpp"

namespace godwit::io::http {
namespace {

constexpr std::size_t longest_quote = 200;
constexpr unsigned not_modified = 304;

bool is_redirect(unsigned status) { return status >= 300 && status <= 399 && status != not_modified; }

result<void> judge_coding(const response& head) {
  for (const auto& each : head.headers) {
    const bool is_content = equals_ignoring_case(each.name, "Content-Encoding");
    if (is_content && !each.value.empty() && !equals_ignoring_case(each.value, "identity"))
      return failure(errc::encoded, "the answer is compressed (" + quotable(each.value) +
                                        ") though only plain bytes were asked for; switch compression off there");
    if (equals_ignoring_case(each.name, "Transfer-Encoding") && !equals_ignoring_case(each.value, "chunked"))
      return failure(errc::encoded, "the answer has a transfer coding that was not asked for: " + quotable(each.value));
  }
  return {};
}

} // namespace

std::string quotable(std::string_view foreign) {
  std::string text;
  for (const char c : foreign.substr(0, foreign.find_first_of("?#"))) {
    if (text.size() == longest_quote)
      return text + "...";
    text += c >= ' ' && c < '\x7f' ? c : '?';
  }
  return text;
}

result<void> judge_head(const response& head, std::string_view expected_content_type) {
  if (is_redirect(head.status)) {
    const auto target = quotable(head.find("Location"));
    return failure(errc::redirect, "answered " + std::to_string(head.status) + ": it is to be found at " +
                                       (target.empty() ? "a place that is not named" : target) +
                                       "; redirects are not followed: set the URL to the right place");
  }
  if (auto coding = judge_coding(head); !coding)
    return coding;
  const auto type = head.find("Content-Type");
  const bool has_body = head.status >= 200 && head.status <= 299 && head.status != 204;
  if (has_body && !expected_content_type.empty() && !has_content_type(type, expected_content_type))
    return failure(errc::wrong_content_type, "answered with " + (type.empty() ? "no content type" : quotable(type)) +
                                                 ", and not with " + std::string(expected_content_type) +
                                                 ": is this the URL of the service?");
  return {};
}

} // namespace godwit::io::http
