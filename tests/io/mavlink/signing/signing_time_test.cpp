#include "io/mavlink/signing/signing_time.hpp"

#include <array>
#include <limits>

#include <gtest/gtest.h>

namespace godwit::io::mavlink::test {
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
