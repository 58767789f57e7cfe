#include "io/mavlink/tlog/frame_shape.hpp"

#include <gtest/gtest.h>

#include "tests/io/mavlink/tlog/tlog_fixture.hpp"

namespace godwit::io::mavlink::test {
namespace frame_shape_test {

byte_buffer plain_heartbeat() { return from_hex("fd09000000ffbe000000000000001208000403211a"); }

TEST(mavlink_frame_shape, a_right_frame_is_v2_also_with_more_bytes_behind_it) {
  auto bytes = plain_heartbeat();
  bytes.resize(bytes.size() + 5);
  const auto found = look(bytes);
  EXPECT_EQ(found.shape, frame_shape::v2);
  EXPECT_EQ(found.size, 21U);
  EXPECT_TRUE(found.is_right());
}

TEST(mavlink_frame_shape, a_part_of_a_frame_is_cut_off) {
  for (const auto& whole : {plain_heartbeat(), v1_frame()})
    for (std::size_t size = 1; size < whole.size(); ++size)
      EXPECT_EQ(look(byte_view(whole).first(size)).shape, frame_shape::cut_off) << size;
}

TEST(mavlink_frame_shape, one_other_byte_makes_the_checksum_bad) {
  for (std::size_t at = 2; at < 21; ++at) {
    auto bytes = plain_heartbeat();
    if (at >= incompat_at && at < id_at && at != 4)
      continue;
    bytes[at] ^= std::byte{0x20};
    const auto found = look(bytes);
    EXPECT_FALSE(found.is_right()) << at;
    EXPECT_NE(found.shape, frame_shape::nothing) << at;
  }
}

TEST(mavlink_frame_shape, other_right_shapes_are_told_apart) {
  EXPECT_EQ(look(with_flags(plain_heartbeat(), 0x02)).shape, frame_shape::unknown_flags);
  EXPECT_EQ(look(v1_frame()).shape, frame_shape::v1);
  EXPECT_EQ(look(unknown_frame(7)).shape, frame_shape::unknown_id);
  EXPECT_EQ(look(unknown_frame(7)).size, 19U);
}

TEST(mavlink_frame_shape, nothing_begins_where_no_magic_is) {
  EXPECT_EQ(look({}).shape, frame_shape::nothing);
  EXPECT_EQ(look(from_hex("00fd")).shape, frame_shape::nothing);
}

} // namespace frame_shape_test
} // namespace godwit::io::mavlink::test
