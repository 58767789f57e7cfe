#include "programs/godwit-sim/line/line_settings.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

#include "programs/godwit-sim/text_forms.hpp"

namespace godwit::sim {
namespace {

struct share_word {
  std::string_view name;
  double line_settings::*value;
};
constexpr share_word shares[] = {{"loss", &line_settings::loss},
                                 {"dup", &line_settings::duplication},
                                 {"reorder", &line_settings::reorder},
                                 {"late", &line_settings::late},
                                 {"biterrors", &line_settings::bit_errors}};

struct duration_word {
  std::string_view name;
  std::chrono::nanoseconds line_settings::*value;
};
constexpr duration_word durations[] = {{"delay", &line_settings::delay}, {"jitter", &line_settings::jitter}};

constexpr std::string_view forms = "; a line is none, or some of loss=0.1,dup=0.01,reorder=0.05,late=0.01,delay=15ms,"
                                   "jitter=5ms,biterrors=1e-5,cut, each for one way only with in. or out. before it";

std::string mistake(std::string_view word, std::string_view what) {
  return in_quotes(word) + " " + std::string(what) + std::string(forms);
}

template <class Words>
auto* find(Words& words, std::string_view name) {
  const auto* const found =
      std::find_if(std::begin(words), std::end(words), [name](const auto& each) { return each.name == name; });
  return found == std::end(words) ? nullptr : found;
}

// The sentence about what is wrong; none: INTO is changed.
std::optional<std::string> read_word(std::string_view whole, std::string_view word, line_settings& into) {
  if (word == "cut") {
    into.is_cut = true;
    return std::nullopt;
  }
  const auto equals = word.find('=');
  const auto name = word.substr(0, equals);
  const auto value = equals == std::string_view::npos ? std::string_view() : word.substr(equals + 1);
  if (const auto* const share = find(shares, name)) {
    const auto number = read_number(value);
    if (!number || *number < 0 || *number > 1)
      return mistake(whole, "is not a share from 0 to 1");
    into.*share->value = *number;
    return std::nullopt;
  }
  if (const auto* const duration = find(durations, name)) {
    const auto length = read_duration(value);
    if (!length || *length > max_line_delay)
      return mistake(whole, "is not a time up to 60s, such as 15ms");
    into.*duration->value = *length;
    return std::nullopt;
  }
  return mistake(whole, "is not a fault of a line");
}

std::optional<std::string> read_word(std::string_view word, line_faults& into) {
  if (word.starts_with("in."))
    return read_word(word, word.substr(3), into.in);
  if (word.starts_with("out."))
    return read_word(word, word.substr(4), into.out);
  if (auto wrong = read_word(word, word, into.in))
    return wrong;
  return read_word(word, word, into.out);
}

void append(std::string& text, std::string_view prefix, const line_settings& from) {
  const auto add = [&](const std::string& word) {
    text += text.empty() ? "" : ",";
    text.append(prefix).append(word);
  };
  for (const auto& each : shares)
    if (from.*each.value != 0)
      add(std::string(each.name) + "=" + shortest(from.*each.value));
  for (const auto& each : durations)
    if ((from.*each.value).count() != 0)
      add(std::string(each.name) + "=" + shortest(static_cast<double>((from.*each.value).count()) / 1e6) + "ms");
  if (from.is_cut)
    add("cut");
}

} // namespace

tl::expected<line_faults, std::string> parse_line_faults(std::string_view text) {
  line_faults result;
  if (trimmed(text) == "none")
    return result;
  for (const auto word : parts_of(text, ','))
    if (auto wrong = read_word(word, result))
      return tl::make_unexpected(*std::move(wrong));
  return result;
}

std::string text_of(const line_faults& faults) {
  std::string text;
  if (faults.in == faults.out) {
    append(text, "", faults.in);
  } else {
    append(text, "in.", faults.in);
    append(text, "out.", faults.out);
  }
  return text.empty() ? "none" : text;
}

} // namespace godwit::sim
