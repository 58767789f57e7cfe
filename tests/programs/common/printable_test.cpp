#include "programs/common/printable.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace godwit::programs {
namespace printable_test {

TEST(printable, control_characters_are_shown_and_do_nothing) {
  EXPECT_EQ(printable("\x1b[2Jred\a\r\x7f"), "\\x1b[2Jred\\x07\\x0d\\x7f");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m")
      << "CSI as one character";
}

TEST(printable, words_in_any_language_and_tabs_stay) {
  EXPECT_EQ(printable("H\xc3\xb6"
                      "he\t\xc2\xb0 \xe2\x82\xac"),
            "H\xc3\xb6"
            "he\t\xc2\xb0 \xe2\x82\xac");
}

TEST(printable, what_turns_the_line_around_or_is_not_seen_is_shown) {
  EXPECT_EQ(printable("a\xe2\x80\xae"
                      "b"),
            "a\\xe2\\x80\\xaeb")
      << "right to left";
  for (const std::string unseen : {"\xd8\x9c", "\xe2\x80\x8b", "\xe2\x80\x8f", "\xe2\x80\xa8", "\xe2\x80\xa9",
                                   "\xe2\x81\xa6", "\xe2\x81\xa9", "\xef\xbb\xbf", "\xc2\xad", "\xf3\xa0\x80\x81"})
    EXPECT_EQ(printable(unseen).find(unseen), std::string::npos);
  EXPECT_EQ(printable("\xe2\x82\xac \xe2\x80\x93 \xf0\x9f\x9a\x81"), "\xe2\x82\xac \xe2\x80\x93 \xf0\x9f\x9a\x81")
      << "a currency, a dash, a helicopter";
}

TEST(printable, one_line_is_one_line_and_stays_as_it_is_when_it_is_escaped_again) {
  EXPECT_EQ(one_line("a\nerror: fake row\n"), "a\\x0aerror: fake row\\x0a");
  EXPECT_EQ(one_line(""), "");
  EXPECT_EQ(printable(one_line("a\n\x1b\xe2\x80\xae")), one_line("a\n\x1b\xe2\x80\xae"));
}

TEST(printable, a_line_end_begins_no_line_that_looks_like_ours) {
  EXPECT_EQ(printable("no\nerror: godwitd: fake"), "no\n    error: godwitd: fake");
}

TEST(printable, what_turns_the_direction_of_reading_is_shown_and_does_nothing) {
  EXPECT_EQ(printable("a\u202Eb"), "a\\xe2\\x80\\xaeb");
  EXPECT_EQ(printable("\u2066\u2069\u200F\u061C\u2028"),
            "\\xe2\\x81\\xa6\\xe2\\x81\\xa9\\xe2\\x80\\x8f\\xd8\\x9c\\xe2\\x80\\xa8");
  EXPECT_EQ(printable("\u2013\u201E"), "\u2013\u201E") << "a dash and a quotation mark stay";
}

RC_GTEST_PROP(printable_property, nothing_active_is_left_and_only_line_ends_begin_a_line, (const std::string& text)) {
  const auto shown = one_line(text);
  RC_ASSERT(
      std::ranges::none_of(shown, [](char each) { return static_cast<unsigned char>(each) < 0x20 && each != '\t'; }));
  RC_ASSERT(one_line(shown) == shown);
  const auto lines = printable(text);
  RC_ASSERT(std::ranges::count(lines, '\n') == std::ranges::count(text, '\n'));
}

} // namespace printable_test
} // namespace godwit::programs
