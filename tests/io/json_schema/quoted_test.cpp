#include "io/json_schema/quoted.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace godwit::io::schemas {
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
} // namespace godwit::io::schemas
