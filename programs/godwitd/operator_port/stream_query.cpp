#include "programs/godwitd/operator_port/stream_query.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace godwit::operator_port {
namespace {

using telemetry_stream::topic;
using telemetry_stream::wanted_topic;
using wanted_list = std::vector<wanted_topic>;

constexpr double lowest_rate_hz = 0.01;
constexpr double highest_rate_hz = 100;

std::string names_of_all() {
  std::string result;
  for (const auto& [what, name] : enum_names(topic{}))
    result.append(result.empty() ? "" : ", ").append(name);
  return result;
}

// Only what a name of a topic can have comes back in a sentence.
bool is_plain(std::string_view text) {
  return text.size() <= 32 &&
         std::ranges::all_of(text, [](char c) { return (c >= 'a' && c <= 'z') || c == '_' || (c >= '0' && c <= '9'); });
}

tl::expected<wanted_topic, std::string> read_topic(std::string_view text) {
  const auto end = std::min(text.find('@'), text.size());
  const auto name = text.substr(0, end);
  const auto known = io::value_of<topic>(name);
  if (!known)
    return tl::make_unexpected((is_plain(name) ? "There is no topic " + std::string(name) : "That is no topic") +
                               "; there are " + names_of_all() + ".");
  wanted_topic result{*known, 0};
  if (end == text.size())
    return result;
  double rate_hz = 0;
  const auto digits = text.substr(end + 1);
  const auto [stop, failed] = std::from_chars(digits.data(), digits.data() + digits.size(), rate_hz);
  if (failed != std::errc() || stop != digits.data() + digits.size() || !(rate_hz >= lowest_rate_hz) ||
      rate_hz > highest_rate_hz)
    return tl::make_unexpected("After @ comes how often a second, 0.01 to 100.");
  result.interval_ns = static_cast<std::int64_t>(1e9 / rate_hz);
  return result;
}

wanted_list all_topics() {
  wanted_list result;
  for (const auto& [what, name] : enum_names(topic{}))
    result.push_back({what, 0});
  return result;
}

} // namespace

tl::expected<wanted_list, std::string> read_topics(std::string_view target) {
  constexpr std::string_view key = "topics=";
  const auto mark = target.find('?');
  if (mark == std::string_view::npos)
    return all_topics();
  auto query = target.substr(mark + 1);
  if (!query.starts_with(key) || query.find('&') != std::string_view::npos)
    return tl::make_unexpected("The only parameter is topics=NAME,NAME.");
  query.remove_prefix(key.size());
  wanted_list result;
  while (!query.empty() && result.size() < telemetry_stream::topic_count) {
    const auto end = std::min(query.find(','), query.size());
    const auto each = read_topic(query.substr(0, end));
    if (!each)
      return tl::make_unexpected(each.error());
    result.push_back(*each);
    query.remove_prefix(std::min(end + 1, query.size()));
  }
  if (result.empty() || !query.empty())
    return tl::make_unexpected("It wants one topic or more, each once; there are " + names_of_all() + ".");
  return result;
}

} // namespace godwit::operator_port
