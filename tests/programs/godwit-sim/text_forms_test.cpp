#include "programs/godwit-sim/text_forms.hpp"

#include <gtest/gtest.h>

namespace godwit::sim {
namespace text_forms_test {

using namespace std::chrono_literals;

TEST(text_forms, numbers_are_read_as_a_whole_or_not_at_all) {
  EXPECT_EQ(read_number("-12.5e1"), -125.0);
  for (const char* text : {"", "1x", " 1", "nan", "inf", "1,5", "0x10"})
    EXPECT_FALSE(read_number(text)) << text;
  EXPECT_EQ(read_whole_number("18446744073709551615"), UINT64_MAX);
  for (const char* text : {"", "-1", "1.0", "18446744073709551616"})
    EXPECT_FALSE(read_whole_number(text)) << text;
}

TEST(text_forms, a_duration_has_a_unit) {
  EXPECT_EQ(read_duration("15ms"), 15ms);
  EXPECT_EQ(read_duration("1.5s"), 1500ms);
  EXPECT_EQ(read_duration("2min"), 2min);
  EXPECT_EQ(read_duration("250us"), 250us);
  EXPECT_EQ(read_duration("0s"), 0s);
  for (const char* text : {"", "15", "s", "ms", "-1s", "1h", "1e300s", "nans"})
    EXPECT_FALSE(read_duration(text)) << text;
}

TEST(text_forms, the_shortest_text_of_a_number_reads_back_as_the_same) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(15), "15");
  for (const double value : {1.0 / 3, 1e-5, 123456.789, 5e-324})
    EXPECT_EQ(read_number(shortest(value)), value);
}

TEST(text_forms, parts_lose_the_spaces_around_them) {
  EXPECT_EQ(parts_of(" a, b c ,,d", ','), (std::vector<std::string_view>{"a", "b c", "", "d"}));
  EXPECT_EQ(parts_of("", ','), std::vector<std::string_view>{""});
}

TEST(text_forms, somebody_elses_text_is_shown_printable_and_not_too_long) {
  EXPECT_EQ(in_quotes("a\nb\x1b"), "\"a?b?\"");
  EXPECT_LT(in_quotes(std::string(1'000, 'x')).size(), 100U);
}

} // namespace text_forms_test
} // namespace godwit::sim
