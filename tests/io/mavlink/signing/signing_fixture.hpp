// What the tests of signing share: a key, a moment, and signed frames. Times in nanoseconds since 1970 UTC.
#pragma once

#include "io/mavlink/codec.hpp"
#include "io/mavlink/signing/signer.hpp"
#include "tests/io/mavlink/mavlink_fixture.hpp"

namespace godwit::io::mavlink::test {

inline constexpr std::int64_t second_ns = 1'000'000'000;
inline constexpr std::int64_t some_day_ns = 1'781'000'000 * second_ns; // in 2026

// 32 bytes that begin with FIRST and go up by one.
[[nodiscard]] secret_key counting_key(std::uint8_t first = 0);

// A heartbeat of 255/190, as the signed golden frame holds it.
[[nodiscard]] frame_buffer golden_heartbeat(signing sign);

// FRAME, which waits for it, with a signature for exactly TIME.
[[nodiscard]] frame_buffer signed_at(frame_buffer frame, signing_time time, link_id link = link_id{3},
                                     std::uint8_t key_first = 0);
// A heartbeat of SYSTEM/1.
[[nodiscard]] frame_buffer heartbeat_at(signing_time time, std::uint8_t system = 1, link_id link = link_id{3});

[[nodiscard]] constexpr signing_time earlier(signing_time time, std::uint64_t by) {
  return signing_time{units(time) - by};
}

} // namespace godwit::io::mavlink::test
