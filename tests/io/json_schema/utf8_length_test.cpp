#include "io/json_schema/utf8_length.hpp"

#include <gtest/gtest.h>

namespace godwit::io::schemas {
namespace utf8_length_test {

TEST(utf8_length, characters_are_counted_and_not_bytes) {
  EXPECT_EQ(utf8_length(""), 0U);
  EXPECT_EQ(utf8_length("ab"), 2U);
  EXPECT_EQ(utf8_length("жa€😀"), 4U);
}

} // namespace utf8_length_test
} // namespace godwit::io::schemas
