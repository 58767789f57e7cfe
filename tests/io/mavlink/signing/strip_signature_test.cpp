#include "io/mavlink/signing/strip_signature.hpp"

#include <gtest/gtest.h>

#include "io/mavlink/crc.hpp"
#include "io/mavlink/messages.hpp"
#include "tests/io/mavlink/signing/signing_fixture.hpp"

namespace godwit::io::mavlink::test {
namespace strip_signature_test {

TEST(mavlink_strip_signature, a_stripped_frame_equals_the_one_that_was_never_signed) {
  const auto signed_frame = heartbeat_at(signing_time{5}, 255);
  const auto golden = signed_at(golden_heartbeat(signing::on), signing_time{5});
  unsigned_frame_bytes memory;
  EXPECT_EQ(to_hex(strip_signature(golden.view(), memory).bytes()), to_hex(golden_heartbeat(signing::off).span()));
  EXPECT_TRUE(crc_matches(strip_signature(signed_frame.view(), memory), heartbeat::crc_extra));
}

TEST(mavlink_strip_signature, an_unsigned_frame_stays_where_it_is) {
  const auto frame = golden_heartbeat(signing::off);
  unsigned_frame_bytes memory;
  EXPECT_EQ(strip_signature(frame.view(), memory).bytes().data(), frame.span().data());
}

TEST(mavlink_strip_signature, holds_for_payloads_of_every_length_and_ids_that_nobody_knows) {
  std::mt19937_64 random(2);
  for (std::size_t length = 1; length <= max_payload_size; ++length) {
    byte_buffer payload(length);
    for (auto& each : payload)
      each = static_cast<std::byte>(random());
    payload.back() = std::byte{1}; // so that it is not cut
    const std::uint32_t id = 0xFFFF00;
    const auto crc_extra = static_cast<std::uint8_t>(random());
    const auto sequence = static_cast<std::uint8_t>(random());
    const frame_buffer plain(id, crc_extra, payload, {1, 2}, sequence, false);
    const auto other = signed_at(frame_buffer(id, crc_extra, payload, {1, 2}, sequence, true), signing_time{7});
    unsigned_frame_bytes memory;
    EXPECT_EQ(to_hex(strip_signature(other.view(), memory).bytes()), to_hex(plain.span())) << length;
  }
}

TEST(mavlink_strip_signature, zeros_at_the_end_of_the_payload_and_unknown_compatible_flags_stay) {
  // An untrimmed EXTENDED_SYS_STATE with compat flags 0x40, signed.
  byte_buffer bytes = from_hex("fd020140010101f50000"
                               "0000"
                               "0000"
                               "00000000000000000000000000");
  const auto crc = frame_crc(byte_view(bytes).subspan(1, header_size + 2 - 1), extended_sys_state::crc_extra);
  std::memcpy(bytes.data() + header_size + 2, &crc, crc_size);
  unsigned_frame_bytes memory;
  const auto stripped = strip_signature(frame_view(bytes.data()), memory);
  EXPECT_TRUE(crc_matches(stripped, extended_sys_state::crc_extra));
  EXPECT_EQ(stripped.payload().size(), 2U);
  EXPECT_EQ(byte_at(stripped.bytes().data(), compat_at), 0x40) << "as it was";
}

TEST(mavlink_strip_signature, a_wrong_checksum_stays_wrong) {
  const auto frame = heartbeat_at(signing_time{5});
  byte_buffer bytes(frame.span().begin(), frame.span().end());
  bytes[header_size] ^= std::byte{4};
  unsigned_frame_bytes memory;
  EXPECT_FALSE(crc_matches(strip_signature(frame_view(bytes.data()), memory), heartbeat::crc_extra));
}

} // namespace strip_signature_test
} // namespace godwit::io::mavlink::test
