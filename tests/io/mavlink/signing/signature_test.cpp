#include "io/mavlink/signing/signature.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/io/mavlink/signing/signing_fixture.hpp"

namespace godwit::io::mavlink::test {
namespace signature_test {

// Made with the C code of the reference generator: key 00..1f, link 3.
constexpr std::string_view golden = "fd09010000ffbe000000000000001208000403c6e2036655443322115b1a95938762";
constexpr signing_time golden_time{0x1122'3344'5566};

TEST(mavlink_signature, a_signed_frame_equals_the_one_of_the_reference_byte_for_byte) {
  const auto frame = signed_at(golden_heartbeat(signing::on), golden_time);
  EXPECT_EQ(to_hex(frame.span()), golden);
}

TEST(mavlink_signature, the_signed_frame_of_the_reference_is_read_and_found_right) {
  const auto bytes = from_hex(golden);
  const auto frame = view_of(bytes);
  ASSERT_TRUE(frame);
  const auto block = signature_of(*frame);
  EXPECT_EQ(block.link, link_id{3});
  EXPECT_EQ(block.time, golden_time);
  EXPECT_TRUE(std::ranges::equal(store(block), frame->signature()));
  EXPECT_TRUE(frame_hasher(counting_key()).is_right(*frame));
}

TEST(mavlink_signature, every_bit_of_the_frame_and_of_the_key_matters) {
  frame_hasher hasher(counting_key());
  auto bytes = from_hex(golden);
  for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
    if (bit / 8 == length_at || bit / 8 == incompat_at)
      continue; // these change how long the frame is
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
    EXPECT_FALSE(hasher.is_right(frame_view(bytes.data()))) << bit;
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
  }
  EXPECT_TRUE(hasher.is_right(frame_view(bytes.data())));
  EXPECT_FALSE(frame_hasher(counting_key(1)).is_right(frame_view(bytes.data())));
}

TEST(mavlink_signature, a_hasher_goes_on_after_a_move) {
  frame_hasher first(counting_key());
  frame_hasher second(std::move(first));
  const auto bytes = from_hex(golden);
  EXPECT_TRUE(second.is_right(frame_view(bytes.data())));
}

} // namespace signature_test
} // namespace godwit::io::mavlink::test
