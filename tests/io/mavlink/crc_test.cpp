#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include "io/mavlink/crc.hpp"
#include "tests/io/mavlink/mavlink_fixture.hpp"

namespace godwit::io::mavlink {
namespace crc_test {

std::uint16_t crc_by_definition(byte_view bytes, std::uint16_t crc) {
  for (const std::byte each : bytes)
    crc = crc_of_byte(crc, std::to_integer<std::uint8_t>(each));
  return crc;
}

TEST(crc, of_the_digits_is_the_check_value_of_the_catalogue) {
  static_assert(crc_of_text(crc_init, "123456789") == 0x6F91);
  EXPECT_EQ(crc_of(std::as_bytes(std::span(std::string_view("123456789")))), 0x6F91);
}

TEST(crc, of_nothing_is_where_it_began) {
  EXPECT_EQ(crc_of({}), crc_init);
  EXPECT_EQ(crc_of({}, 0x1234), 0x1234);
}

TEST(crc, of_each_length_up_to_a_frame_and_each_alignment_is_that_of_the_definition) {
  std::mt19937_64 random(1);
  byte_buffer bytes(max_frame_size + 16);
  for (auto& each : bytes)
    each = static_cast<std::byte>(random());
  for (std::size_t offset = 0; offset < 16; ++offset)
    for (std::size_t length = 0; length <= max_frame_size; ++length) {
      const auto part = byte_view(bytes).subspan(offset, length);
      ASSERT_EQ(crc_of(part), crc_by_definition(part, crc_init)) << offset << '+' << length;
    }
}

TEST(crc, of_a_frame_ends_with_its_extra_byte) {
  const auto bytes = from_hex("09000000ffbe000000000000001208000403");
  EXPECT_EQ(frame_crc(bytes, 50), crc_of_byte(crc_of(bytes), 50));
  EXPECT_EQ(frame_crc(bytes, 50), 0x1A21);
}

RC_GTEST_PROP(crc_property, of_any_bytes_in_two_parts_is_that_of_the_definition, ()) {
  const auto numbers = *rc::gen::container<std::vector<std::uint8_t>>(rc::gen::arbitrary<std::uint8_t>());
  const auto begin = *rc::gen::arbitrary<std::uint16_t>();
  const auto bytes = std::as_bytes(std::span(numbers));
  const auto cut = *rc::gen::inRange<std::size_t>(0, bytes.size() + 1);
  RC_ASSERT(crc_of(bytes.subspan(cut), crc_of(bytes.first(cut), begin)) == crc_by_definition(bytes, begin));
}

} // namespace crc_test
} // namespace godwit::io::mavlink
