#include "actors/mission_client/outbox/recorded_answer.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "io/fields/utf8.hpp"

namespace godwit::mission_client {

namespace {

std::size_t end_of_part(std::string_view body, std::size_t from) {
  if (body.size() > max_recorded_body_bytes)
    return body.size();
  return from + std::max<std::size_t>(io::whole_characters(body.substr(from), answer_part_bytes), 1);
}

} // namespace

recorded_answer next_part(const service_news& news, std::size_t& from) {
  const auto& body = news.what.body;
  recorded_answer result;
  if (from == 0) {
    result.call = news.call;
    result.how = static_cast<std::uint8_t>(news.what.how);
    result.status = news.what.status;
    result.retry_after_ns = news.what.retry_after_ns;
    result.error = news.what.error;
    for (auto end = end_of_part(body, 0); end < body.size(); end = end_of_part(body, end))
      ++result.parts;
  }
  const auto end = end_of_part(body, from);
  result.body = body.substr(from, end - from);
  from = end;
  return result;
}

service_news news_of(recorded_answer first) {
  return {first.call,
          {.how = static_cast<ending>(first.how),
           .status = first.status,
           .body = std::move(first.body),
           .retry_after_ns = first.retry_after_ns,
           .error = std::move(first.error)}};
}

} // namespace godwit::mission_client
