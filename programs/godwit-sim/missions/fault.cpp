#include "programs/godwit-sim/missions/fault.hpp"

#include <array>
#include <span>
#include <vector>

#include "programs/godwit-sim/text_forms.hpp"

namespace godwit::sim::missions {

namespace {

using words = std::span<const std::string_view>;
using parsed = tl::expected<fault::any, std::string>;

// The words that are left are those of the rule: on, from, times.
struct cursor {
  words rest;

  [[nodiscard]] bool is_at_end() const { return rest.empty(); }
  std::string_view take() {
    if (rest.empty())
      return {};
    const auto first = rest.front();
    rest = rest.subspan(1);
    return first;
  }
  bool skip(std::string_view word) {
    const bool is_there = !rest.empty() && rest.front() == word;
    if (is_there)
      rest = rest.subspan(1);
    return is_there;
  }
};

tl::unexpected<std::string> wrong(std::string_view word, std::string_view form) {
  return tl::unexpected((word.empty() ? std::string("what comes next is missing") : in_quotes(word) + " is wrong") +
                        "; it is " + std::string(form));
}

tl::expected<std::chrono::nanoseconds, std::string> take_time(cursor& from) {
  const auto word = from.take();
  const auto time = read_duration(word);
  if (!time || *time > longest_fault_time)
    return wrong(word, "a time of up to an hour, such as 250ms or 2s");
  return *time;
}

tl::expected<std::uint64_t, std::string> take_number(cursor& from, std::uint64_t min, std::uint64_t max) {
  const auto word = from.take();
  const auto number = read_whole_number(word);
  if (!number || *number < min || *number > max)
    return wrong(word, "a whole number from " + std::to_string(min) + " to " + std::to_string(max));
  return *number;
}

constexpr std::uint64_t most = 1'000'000'000; // calls, or bytes a second

parsed take_refuse(cursor& from) {
  if (from.is_at_end())
    return fault::refuse{};
  if (!from.skip("for"))
    return wrong(from.take(), "refuse, or refuse for 5s");
  return take_time(from).map([](auto time) -> fault::any { return fault::refuse{time}; });
}

parsed take_status(cursor& from) {
  fault::status made;
  const auto code = take_number(from, 400, 599);
  if (!code)
    return tl::unexpected(code.error());
  made.code = static_cast<unsigned>(*code);
  if (from.skip("retry-after")) {
    const auto seconds = take_number(from, 0, 86'400);
    if (!seconds)
      return tl::unexpected(seconds.error());
    made.retry_after_s = *seconds;
  }
  made.is_committed = from.skip("committed");
  return made;
}

parsed take_delay(cursor& from) {
  return take_time(from).map([](auto time) -> fault::any { return fault::delay{time}; });
}

parsed take_slow(cursor& from) {
  return take_number(from, 1, most).map([](auto bytes) -> fault::any { return fault::slow{bytes}; });
}

parsed take_content_type(cursor& from) {
  const auto word = from.take();
  for (const char each : word)
    if (each <= ' ' || each > '~')
      return wrong(word, "a media type, such as text/html");
  if (word.empty())
    return wrong(word, "a media type, such as text/html");
  return fault::content_type{std::string(word)};
}

template <class Plain>
parsed take_plain(cursor&) {
  return Plain{};
}

struct fault_row {
  std::string_view word;
  parsed (*take)(cursor& from);
};

constexpr std::array fault_rows{
    fault_row{"refuse", take_refuse},
    fault_row{"wrong-host", take_plain<fault::wrong_host>},
    fault_row{"drop", take_plain<fault::drop>},
    fault_row{"status", take_status},
    fault_row{"lose", take_plain<fault::lose>},
    fault_row{"delay", take_delay},
    fault_row{"slow", take_slow},
    fault_row{"reset", take_plain<fault::reset>},
    fault_row{"content-type", take_content_type},
    fault_row{"truncate", take_plain<fault::truncate>},
    fault_row{"huge", take_plain<fault::huge>},
    fault_row{"schema", take_plain<fault::schema>},
    fault_row{"version", take_plain<fault::version>},
};

parsed take_what(cursor& from) {
  const auto word = from.take();
  std::string all;
  for (const auto& row : fault_rows) {
    if (row.word == word)
      return row.take(from);
    all.append(all.empty() ? "" : ", ").append(row.word);
  }
  return tl::unexpected(in_quotes(word) + " is no fault; there are " + all);
}

std::string all_calls() {
  std::string all;
  for (const auto& [value, name] : enum_names(endpoint{}))
    all.append(all.empty() ? "" : ", ").append(name);
  return all;
}

tl::expected<void, std::string> take_place(cursor& from, fault_rule& to) {
  if (from.skip("on")) {
    const auto word = from.take();
    to.where = io::value_of<endpoint>(word);
    if (!to.where)
      return wrong(word, "a call: " + all_calls());
  }
  if (from.skip("from")) {
    const auto number = take_number(from, 1, most);
    if (!number)
      return tl::unexpected(number.error());
    to.from = *number;
  }
  if (from.skip("times")) {
    const auto number = take_number(from, 1, most);
    if (!number)
      return tl::unexpected(number.error());
    to.times = *number;
  }
  if (!from.is_at_end())
    return wrong(from.take(), "WHAT [on CALL] [from N] [times N]");
  return {};
}

} // namespace

tl::expected<fault_rule, std::string> parse_fault_rule(std::string_view text) {
  std::vector<std::string_view> all;
  for (const auto word : parts_of(trimmed(text), ' '))
    if (!word.empty())
      all.push_back(word);
  cursor from{all};
  auto what = take_what(from);
  if (!what)
    return tl::unexpected(std::move(what.error()));
  fault_rule made{.what = *std::move(what), .where = {}, .times = {}};
  if (auto placed = take_place(from, made); !placed)
    return tl::unexpected(std::move(placed.error()));
  if (std::holds_alternative<fault::wrong_host>(made.what) && made.where)
    return tl::unexpected(std::string("wrong-host is about connections and not about calls: leave `on` out"));
  if (std::holds_alternative<fault::refuse>(made.what) && (made.where || made.times || made.from != 1))
    return tl::unexpected(std::string("who refuses connections can not count them; it is refuse, or refuse for 5s"));
  return made;
}

} // namespace godwit::sim::missions
