#include "actors/ground_port/passing/file_transfer.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

#include "actors/ground_port/passing/payload_byte.hpp"

namespace godwit::ground_port::passing {

namespace {

// In the payload of the message: network, target system, target component, and the protocol's own header after.
constexpr std::size_t sequence_at = 3;
constexpr std::size_t session_at = 5;
constexpr std::size_t opcode_at = 6;
constexpr std::size_t size_at = 7;
constexpr std::size_t asked_opcode_at = 8;
constexpr std::size_t data_at = 15;

constexpr std::uint8_t nak = 129;
constexpr std::uint8_t error_fail = 1;

// None, terminate and reset sessions, list, open for reading, read, checksum, burst.
constexpr std::array<std::uint8_t, 8> reading{0, 1, 2, 3, 4, 5, 14, 15};

bool names_plans(io::mavlink::byte_view payload) {
  std::string path;
  for (auto at = data_at; at < payload.size(); ++at)
    path += static_cast<char>(std::toupper(std::to_integer<unsigned char>(payload[at])));
  return path.find("@MISSION") != std::string::npos;
}

} // namespace

file_access file_access_of(io::mavlink::byte_view payload) {
  if (std::ranges::find(reading, byte_at(payload, opcode_at)) != reading.end())
    return file_access::read;
  return names_plans(payload) ? file_access::write_plan : file_access::write;
}

std::vector<std::uint8_t> file_refusal(io::mavlink::byte_view payload, io::mavlink::sender to) {
  std::vector<std::uint8_t> result(data_at + 1);
  const auto sequence =
      static_cast<std::uint16_t>(byte_at(payload, sequence_at) + (byte_at(payload, sequence_at + 1) << 8U) + 1);
  result[1] = to.system;
  result[2] = to.component;
  result[sequence_at] = static_cast<std::uint8_t>(sequence & 0xFFU);
  result[sequence_at + 1] = static_cast<std::uint8_t>(sequence >> 8U);
  result[session_at] = byte_at(payload, session_at);
  result[opcode_at] = nak;
  result[size_at] = 1;
  result[asked_opcode_at] = byte_at(payload, opcode_at);
  result[data_at] = error_fail;
  return result;
}

} // namespace godwit::ground_port::passing
