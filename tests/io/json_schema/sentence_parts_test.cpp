#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/json_schema/sentence_parts.hpp"

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

namespace quoted_test {

TEST(quoted, a_text_stands_in_quotes_on_one_line) { EXPECT_EQ(in_quotes("a\n\"b\""), R"("a\n\"b\"")"); }

TEST(quoted, a_long_text_is_cut) {
  EXPECT_EQ(in_quotes(std::string(61, 'x')), '"' + std::string(60, 'x') + "...\"");
  EXPECT_EQ(in_quotes(std::string(60, 'x')), '"' + std::string(60, 'x') + '"');
}

TEST(quoted, what_is_not_utf_8_becomes_it) {
  for (const auto* text : {"\xff", "\xc3", "ab\xf0\x9f"})
    EXPECT_TRUE(nlohmann::json::accept(in_quotes(text)));
  EXPECT_TRUE(nlohmann::json::accept(in_quotes(std::string(59, 'x') + "ж"))) << "cut within a character";
}

} // namespace quoted_test

namespace utf8_length_test {

TEST(utf8_length, characters_are_counted_and_not_bytes) {
  EXPECT_EQ(utf8_length(""), 0U);
  EXPECT_EQ(utf8_length("ab"), 2U);
  EXPECT_EQ(utf8_length("жa€😀"), 4U);
}

} // namespace utf8_length_test

} // namespace godwit::io::schemas
