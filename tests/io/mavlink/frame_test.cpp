#include <gtest/gtest.h>

#include "io/mavlink/frame.hpp"
#include "tests/io/mavlink/mavlink_fixture.hpp"

namespace godwit::io::mavlink {
namespace frame_test {

constexpr auto signed_heartbeat = "fd09010000ffbe000000000000001208000403c6e2036655443322115b1a95938762";

TEST(frame, view_reads_each_part_of_the_header) {
  const auto bytes = from_hex("fd0300070405064e0300010203aabb");
  const auto frame = view_of(bytes);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->incompat(), 0);
  EXPECT_EQ(frame->sequence(), 4);
  EXPECT_EQ(frame->system(), 5);
  EXPECT_EQ(frame->component(), 6);
  EXPECT_EQ(frame->from(), (sender{5, 6}));
  EXPECT_EQ(frame->id(), 0x34EU);
  EXPECT_EQ(to_hex(frame->payload()), "010203");
  EXPECT_EQ(frame->crc(), 0xBBAA);
  EXPECT_FALSE(frame->is_signed());
  EXPECT_TRUE(frame->signature().empty());
}

TEST(frame, view_of_a_signed_one_has_the_signature_apart) {
  const auto bytes = from_hex(signed_heartbeat);
  const auto frame = view_of(bytes);
  ASSERT_TRUE(frame);
  EXPECT_TRUE(frame->is_signed());
  EXPECT_EQ(frame->size(), 34U);
  EXPECT_EQ(to_hex(frame->signature()), "036655443322115b1a95938762");
  EXPECT_EQ(to_hex(frame->payload()), "000000001208000403");
  EXPECT_TRUE(crc_matches(*frame, heartbeat::crc_extra));
}

TEST(frame, view_is_only_given_of_exactly_one_frame) {
  const auto whole = from_hex(signed_heartbeat);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(view_of(byte_view(whole).first(size))) << size;
  auto longer = whole;
  longer.push_back(std::byte{0});
  EXPECT_FALSE(view_of(longer));
  auto other_magic = whole;
  other_magic[0] = magic_v1;
  EXPECT_FALSE(view_of(other_magic));
}

TEST(frame, with_one_bit_changed_fails_its_checksum) {
  const auto whole = from_hex("fd09000000ffbe000000000000001208000403211a");
  for (std::size_t bit = 24; bit < whole.size() * 8; ++bit) { // after length and flag, which move the checksum
    auto changed = whole;
    changed[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
    EXPECT_FALSE(crc_matches(frame_view(changed.data()), heartbeat::crc_extra)) << bit;
  }
}

TEST(frame, that_is_to_be_signed_waits_for_its_signature) {
  auto frame = encode(heartbeat{.type = 18, .autopilot = 8, .system_status = 4}, {255, 190}, 0, signing::on);
  EXPECT_FALSE(frame.is_complete());
  EXPECT_EQ(to_hex(frame.span()), std::string_view(signed_heartbeat).substr(0, 42));
  const auto signature = from_hex("036655443322115b1a95938762");
  frame.append_signature(std::span<const std::byte, signature_size>(signature));
  EXPECT_TRUE(frame.is_complete());
  EXPECT_EQ(to_hex(frame.span()), signed_heartbeat);
  EXPECT_EQ(frame.view().size(), frame.size());
}

TEST(frame, buffer_copies_its_bytes) {
  const auto first = encode(mission_item_reached{1}, {1, 1}, 9);
  auto second = encode(heartbeat{}, {1, 1}, 0);
  second = first;
  const frame_buffer third(second);
  EXPECT_EQ(to_hex(second.span()), "fd0100000901012e0000016534");
  EXPECT_EQ(to_hex(third.span()), "fd0100000901012e0000016534");
}

TEST(frame, of_the_longest_signed_message_fits) {
  const byte_buffer payload(max_payload_size, std::byte{1});
  frame_buffer frame(0xFFFFFF, 0, payload, {255, 255}, 255, true);
  const byte_buffer signature(signature_size);
  frame.append_signature(std::span<const std::byte, signature_size>(signature));
  EXPECT_EQ(frame.size(), max_frame_size);
  EXPECT_EQ(frame.view().id(), 0xFFFFFFU);
}

TEST(frame_death, a_second_signature_is_a_broken_invariant) {
  auto frame = encode(heartbeat{}, {1, 1}, 0);
  const byte_buffer signature(signature_size);
  EXPECT_DEATH(frame.append_signature(std::span<const std::byte, signature_size>(signature)), "signature_size");
}

} // namespace frame_test
} // namespace godwit::io::mavlink
