#include "programs/godwit-trace/name_filter.hpp"

#include <algorithm>

#include "io/text.hpp"
#include "programs/godwit-trace/message_forms.hpp"

namespace godwit::trace_tool {

namespace {

constexpr std::string_view blanks = " \t";

std::string in_capitals(std::string_view text) {
  std::string result(text);
  for (char& each : result)
    each = each >= 'a' && each <= 'z' ? static_cast<char>(each - 'a' + 'A') : each;
  return result;
}

bool is_pattern(std::string_view text) { return text.find('*') != std::string_view::npos; }

// UNKNOWN_ and an id, or a pattern that such a name could match.
bool can_be_unknown(std::string_view pattern) {
  if (is_pattern(pattern)) {
    const auto fixed = pattern.substr(0, pattern.find('*'));
    return fixed.starts_with(unknown_prefix) || unknown_prefix.starts_with(fixed);
  }
  return pattern.starts_with(unknown_prefix) && pattern.size() > unknown_prefix.size() &&
         pattern.find_first_not_of("0123456789", unknown_prefix.size()) == std::string_view::npos;
}

} // namespace

bool matches(std::string_view pattern, std::string_view text) {
  std::size_t at = 0;
  std::size_t in_text = 0;
  std::size_t star = std::string_view::npos; // the last one, and what it has swallowed up to
  std::size_t swallowed = 0;
  while (in_text < text.size()) {
    if (at < pattern.size() && pattern[at] == '*') {
      star = at++;
      swallowed = in_text;
    } else if (at < pattern.size() && pattern[at] == text[in_text]) {
      ++at;
      ++in_text;
    } else if (star != std::string_view::npos) {
      at = star + 1;
      in_text = ++swallowed;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', at) == std::string_view::npos;
}

tl::expected<name_filter, std::string> name_filter::parse(std::span<const std::string> lists) {
  name_filter filter;
  for (const std::string_view list : lists)
    for (std::size_t begin = 0; begin <= list.size();) {
      const auto end = std::min(list.find(',', begin), list.size());
      if (const auto added = filter.add(in_capitals(io::trimmed(list.substr(begin, end - begin), blanks))); !added)
        return tl::make_unexpected(added.error());
      begin = end + 1;
    }
  return filter;
}

tl::expected<void, std::string> name_filter::add(std::string pattern) {
  is_all_ = false;
  bool found = false;
  for (const auto& info : io::mavlink::known_ids())
    if (matches(pattern, info.name)) {
      known_.set(io::mavlink::slot_of(info));
      found = true;
    }
  if (can_be_unknown(pattern)) {
    unknown_.push_back(std::move(pattern));
    return {};
  }
  if (found)
    return {};
  if (pattern.empty())
    return tl::make_unexpected(std::string("a name of a message is empty"));
  if (is_pattern(pattern))
    return tl::make_unexpected("no name of a message matches \"" + pattern + "\"");
  return tl::make_unexpected("no message is called \"" + pattern + "\"; the nearest is " +
                             std::string(nearest_message_name(pattern)));
}

bool name_filter::wants(std::uint32_t id) const {
  if (is_all_)
    return true;
  if (const auto* const info = io::mavlink::find_message(id))
    return known_.test(io::mavlink::slot_of(*info));
  const auto name = message_name(id);
  return std::ranges::any_of(unknown_, [&](const std::string& each) { return matches(each, name); });
}

} // namespace godwit::trace_tool
