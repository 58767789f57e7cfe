#include "io/fields/utf8.hpp"

#include <string_view>
#include <utility>

#include <gtest/gtest.h>

namespace utf8_test {

using godwit::io::whole_characters;

TEST(utf8, a_text_that_fits_is_not_cut) {
  EXPECT_EQ(whole_characters("abc", 3), 3U);
  EXPECT_EQ(whole_characters("", 0), 0U);
}

TEST(utf8, no_character_is_cut_in_its_middle) {
  const std::string_view text = "aä€😀"; // of 1, 2, 3 and 4 bytes
  for (const auto& [most, size] :
       {std::pair{0U, 0U}, {1U, 1U}, {2U, 1U}, {3U, 3U}, {5U, 3U}, {6U, 6U}, {9U, 6U}, {10U, 10U}})
    EXPECT_EQ(whole_characters(text, most), size) << most;
}

TEST(utf8, bytes_that_only_continue_characters_leave_nothing) { EXPECT_EQ(whole_characters("\x80\x80\x80", 2), 0U); }

} // namespace utf8_test
