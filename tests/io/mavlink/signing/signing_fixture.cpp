#include "tests/io/mavlink/signing/signing_fixture.hpp"

#include "io/mavlink/messages/heartbeat.hpp"

namespace godwit::io::mavlink::test {

secret_key counting_key(std::uint8_t first) {
  std::array<std::byte, secret_key_size> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i)
    bytes[i] = static_cast<std::byte>(first + i);
  return secret_key(bytes);
}

namespace {

heartbeat onboard_heartbeat() {
  heartbeat message;
  message.type = static_cast<decltype(message.type)>(18);
  message.autopilot = static_cast<decltype(message.autopilot)>(8);
  message.system_status = static_cast<decltype(message.system_status)>(4);
  message.mavlink_version = 3;
  return message;
}

} // namespace

frame_buffer golden_heartbeat(signing sign) { return encode(onboard_heartbeat(), sender{255, 190}, 0, sign); }

frame_buffer signed_at(frame_buffer frame, signing_time time, link_id link, std::uint8_t key_first) {
  frame_hasher hasher(counting_key(key_first));
  frame.append_signature(store({link, time, hasher.hash_of(frame.span(), link, time)}));
  return frame;
}

frame_buffer heartbeat_at(signing_time time, std::uint8_t system, link_id link) {
  return signed_at(encode(onboard_heartbeat(), sender{system, 1}, 0, signing::on), time, link);
}

} // namespace godwit::io::mavlink::test
