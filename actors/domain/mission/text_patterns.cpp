#include "actors/domain/mission/text_patterns.hpp"

#include <algorithm>
#include <string>

#include "runtime/assert.hpp"

namespace godwit::mission {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_small_hex(char c) { return is_digit(c) || (c >= 'a' && c <= 'f'); }

// MGRS leaves out I and O, which look like 1 and 0.
bool is_mgrs_letter(char c) { return c >= 'A' && c <= 'Z' && c != 'I' && c != 'O'; }

// Takes from the front what fits; returns how many characters that were.
template <class Fits>
std::size_t take(std::string_view& text, std::size_t at_most, Fits fits) {
  std::size_t count = 0;
  while (count < at_most && count < text.size() && fits(text[count]))
    ++count;
  text.remove_prefix(count);
  return count;
}

bool take(std::string_view& text, char expected) {
  return take(text, 1, [&](char c) { return c == expected; }) == 1;
}

bool has_form_of(std::string_view text, std::string_view form, bool (*fits)(char)) {
  return text.size() == form.size() && std::ranges::equal(text, form, [&](char found, char wanted) {
           return wanted == 'x' ? fits(found) : found == wanted;
         });
}

bool is_uuid(std::string_view text) { return has_form_of(text, "xxxxxxxx-xxxx-xxxx-xxxx-xxxxxxxxxxxx", is_small_hex); }

bool is_time(std::string_view text) {
  constexpr std::string_view whole = "xxxx-xx-xxTxx:xx:xx";
  if (!has_form_of(text.substr(0, whole.size()), whole, is_digit))
    return false;
  text.remove_prefix(whole.size());
  if (take(text, '.') && take(text, 9, is_digit) == 0)
    return false;
  return text == "Z";
}

bool take_version_number(std::string_view& text) {
  const bool is_zero = text.starts_with('0');
  return take(text, is_zero ? 1 : 6, is_digit) != 0;
}

bool is_version(std::string_view text) {
  return take_version_number(text) && take(text, '.') && take_version_number(text) && take(text, '.') &&
         take_version_number(text) && text.empty();
}

bool is_mgrs_cell(std::string_view text) {
  constexpr std::string_view polar_zones = "ABYZ";
  const bool has_zone_number = take(text, 2, is_digit) != 0;
  const auto is_band = [&](char c) {
    return is_mgrs_letter(c) && (polar_zones.find(c) == std::string_view::npos) == has_zone_number;
  };
  if (take(text, 1, is_band) != 1 || take(text, 2, is_mgrs_letter) != 2)
    return false;
  return text.size() <= 10 && text.size() % 2 == 0 && std::ranges::all_of(text, is_digit);
}

struct pattern_row {
  std::string_view pattern;
  text_test test;
};

constexpr pattern_row rows[] = {
    {"^[0-9a-f]{8}-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{12}$", is_uuid},
    {"^[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}(\\.[0-9]{1,9})?Z$", is_time},
    {"^(0|[1-9][0-9]{0,5})\\.(0|[1-9][0-9]{0,5})\\.(0|[1-9][0-9]{0,5})$", is_version},
    {"^([0-9]{1,2}[C-HJ-NP-X]|[ABYZ])[A-HJ-NP-Z]{2}([0-9]{2}){0,5}$", is_mgrs_cell},
};

} // namespace

text_test test_of_pattern(std::string_view pattern) {
  const auto* const found = std::ranges::find(rows, pattern, &pattern_row::pattern);
  GODWIT_ASSERT(found != std::end(rows), "the program knows the pattern " + std::string(pattern));
  return found->test;
}

} // namespace godwit::mission
