#include "io/json_schema/nearest_word.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace godwit::io::schemas {

namespace nearest_word_test {

const std::vector<std::string> keys{"directory", "segment_mib", "total_mib", "flush_ms"};

TEST(nearest_word, a_missing_letter_is_found) { EXPECT_EQ(nearest_word("segmnt_mib", keys), "segment_mib"); }

TEST(nearest_word, swapped_letters_are_one_step) { EXPECT_EQ(nearest_word("flsuh_ms", keys), "flush_ms"); }

TEST(nearest_word, the_nearest_word_wins) {
  EXPECT_EQ(nearest_word("total_mb", keys), "total_mib");
  EXPECT_EQ(nearest_word("abd", {"abcd", "abd_", "abdx"}), "abcd");
}

TEST(nearest_word, nothing_is_near_a_strange_word) { EXPECT_EQ(nearest_word("altitude", keys), std::nullopt); }

TEST(nearest_word, a_word_that_would_change_altogether_is_not_near) {
  EXPECT_EQ(nearest_word("xy", {"ab", "c"}), std::nullopt);
}

TEST(nearest_word, empty_and_endless_words_have_no_neighbour) {
  EXPECT_EQ(nearest_word("", keys), std::nullopt);
  EXPECT_EQ(nearest_word(std::string(100000, 'x'), {std::string(100000, 'x')}), std::nullopt);
  EXPECT_EQ(nearest_word("a", {}), std::nullopt);
}

} // namespace nearest_word_test

} // namespace godwit::io::schemas
