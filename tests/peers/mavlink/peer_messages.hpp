// What both sides of the peer check agree on: the messages, the key, the time of signing.
#pragma once

#include <array>
#include <cstdint>

#include "io/mavlink/messages.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"
#include "io/mavlink/messages/request_data_stream.hpp"
#include "io/mavlink/signing/secret_key.hpp"

namespace godwit::io::mavlink::peers {

// Those that we read everywhere, the one that we only send, and the one that the mission server alone reads.
using of_few = message_list<request_data_stream, mission_write_partial_list>;

// Calls F.template operator()<M>() for each.
template <class F>
void for_each_message(F&& f) {
  known_messages::for_each(f);
  of_few::for_each(f);
}

// Calls F with the message in FRAME; false if it is none of them.
template <class F>
bool visit_any(const frame_view& frame, F&& f) {
  return known_messages::visit(frame, f) || of_few::visit(frame, f);
}

inline constexpr std::int64_t signing_ns = 1'781'000'000'000'000'000; // since 1970 UTC: a day in 2026

// 00 01 02 .. 1f
[[nodiscard]] inline secret_key test_key() {
  std::array<std::byte, secret_key_size> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i)
    bytes[i] = static_cast<std::byte>(i);
  return secret_key(bytes);
}

} // namespace godwit::io::mavlink::peers
