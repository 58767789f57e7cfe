#include "tests/io/mavlink/mavlink_fixture.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>

namespace godwit::io::mavlink {

byte_buffer from_hex(std::string_view hex) {
  byte_buffer result;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    result.push_back(static_cast<std::byte>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16)));
  return result;
}

std::string to_hex(byte_view bytes) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string result;
  for (const std::byte each : bytes) {
    result += digits[std::to_integer<unsigned>(each) >> 4U];
    result += digits[std::to_integer<unsigned>(each) & 0xFU];
  }
  return result;
}

byte_buffer test_data(const std::string& name) {
  std::ifstream file(GODWIT_TEST_DATA "/" + name, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const auto view = std::as_bytes(std::span(bytes));
  return {view.begin(), view.end()};
}

void append(byte_buffer& to, byte_view bytes) { to.insert(to.end(), bytes.begin(), bytes.end()); }

std::vector<byte_buffer> frames_in(byte_view bytes) {
  std::vector<byte_buffer> result;
  scanner frames;
  frames.feed_datagram(
      bytes, [&](const frame_view& frame) { result.emplace_back(frame.bytes().begin(), frame.bytes().end()); });
  return result;
}

std::vector<byte_buffer> some_frames(std::size_t count, std::mt19937_64& random) {
  std::vector<byte_buffer> result;
  const auto add = [&]<message M>(const M& message) {
    const auto frame = encode(message, {1, 1}, static_cast<std::uint8_t>(result.size()));
    result.emplace_back(frame.span().begin(), frame.span().end());
  };
  while (result.size() < count)
    switch (random() % 4) {
    case 0:
      add(heartbeat{.type = 2, .autopilot = 12, .base_mode = 157, .custom_mode = 50593792, .system_status = 4});
      break;
    case 1:
      add(random_message<attitude>(random));
      break;
    case 2:
      add(random_message<global_position_int>(random));
      break;
    default:
      add(random_message<sys_status>(random));
    }
  return result;
}

} // namespace godwit::io::mavlink
