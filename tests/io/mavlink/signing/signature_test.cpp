#include <algorithm>
#include <array>
#include <limits>

#include <gtest/gtest.h>

#include "io/mavlink/signing/signature.hpp"
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

namespace signing_time_test {

constexpr std::int64_t epoch_ns = signing_epoch_s * 1'000'000'000;

TEST(mavlink_signing_time, counts_ten_microseconds_since_2015) {
  EXPECT_EQ(units(signing_time_at(epoch_ns)), 0U);
  EXPECT_EQ(units(signing_time_at(epoch_ns + 9'999)), 0U);
  EXPECT_EQ(units(signing_time_at(epoch_ns + 10'000)), 1U);
  EXPECT_EQ(units(signing_time_at(epoch_ns + 1'000'000'000)), signing_units_per_s);
}

TEST(mavlink_signing_time, never_wraps) {
  EXPECT_EQ(units(signing_time_at(0)), 0U);
  EXPECT_EQ(units(signing_time_at(-1)), 0U);
  EXPECT_EQ(units(signing_time_at(std::numeric_limits<std::int64_t>::min())), 0U);
  EXPECT_EQ(signing_time_at(std::numeric_limits<std::int64_t>::max()), max_signing_time);
  EXPECT_EQ(later(max_signing_time, 1), max_signing_time);
  EXPECT_EQ(later(signing_time{5}, 7), signing_time{12});
}

TEST(mavlink_signing_time, travels_as_six_bytes_little_endian) {
  std::array<std::byte, signing_time_size> bytes{};
  store_signing_time(bytes, signing_time{0x1122'3344'5566});
  EXPECT_EQ(bytes, (std::array{std::byte{0x66}, std::byte{0x55}, std::byte{0x44}, std::byte{0x33}, std::byte{0x22},
                               std::byte{0x11}}));
  EXPECT_EQ(load_signing_time(bytes), signing_time{0x1122'3344'5566});
  store_signing_time(bytes, max_signing_time);
  EXPECT_EQ(load_signing_time(bytes), max_signing_time);
}

} // namespace signing_time_test

} // namespace godwit::io::mavlink::test
