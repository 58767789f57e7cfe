#include "io/json_schema/utf8_length.hpp"

#include <gtest/gtest.h>

namespace godwit::io::schemas {
namespace {

TEST(utf8_length, characters_are_counted_and_not_bytes) {
  EXPECT_EQ(utf8_length(""), 0U);
  EXPECT_EQ(utf8_length("ab"), 2U);
  EXPECT_EQ(utf8_length("жa€😀"), 4U);
}

} // namespace
} // namespace godwit::io::schemas
