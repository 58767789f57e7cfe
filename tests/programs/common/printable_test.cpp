#include "programs/common/printable.hpp"

#include <gtest/gtest.h>

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

TEST(printable, a_line_end_begins_no_line_that_looks_like_ours) {
  EXPECT_EQ(printable("no\nerror: godwitd: fake"), "no\n    error: godwitd: fake");
}

} // namespace printable_test
} // namespace godwit::programs
