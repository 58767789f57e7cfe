// Names, text and JSON of a MAVLink message.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "io/mavlink/frame.hpp"

namespace godwit::trace_tool {

// The name of a message by its id, also of those that godwit does not decode; and the id by a name that somebody typed.
//
// Ids that are in no table are called UNKNOWN_<id>. Thread: pure.
inline constexpr std::string_view unknown_prefix = "UNKNOWN_";

void append_message_name(std::string& out, std::uint32_t id);
[[nodiscard]] std::string message_name(std::uint32_t id);

// The name in the table that is most like TEXT (capitals): one that contains it, else that of the fewest changed
// letters.
[[nodiscard]] std::string_view nearest_message_name(std::string_view text);

// A frame as one line for people: its name, and its fields as NAME=VALUE in the order of the message's table.
//
//   COMMAND_ACK          command=400(COMPONENT_ARM_DISARM) result=0(ACCEPTED) progress=0 ...
//   ESC_INFO             46 bytes: 00112233445566778899aabbccddeeff...
//
// Numbers of enums have their name after them where it is known; text is in quotes with everything escaped that a
// terminal could take for a command; bytes are hexadecimal. What godwit does not decode is shown by its first bytes.
// Secrets are never shown. Thread: pure.
void append_message_text(std::string& out, const io::mavlink::frame_view& frame);

// Which field of which message holds which enum: the one table from which numbers get their names.
//
// A number without a name has none here either, and is shown as the number that it is. Thread: constants.
struct enum_field {
  std::uint32_t message_id = 0;
  std::string_view field;
  // Appends the name of VALUE in capitals, as MAVLink writes it; for bits all their names. Nothing if there is none.
  void (*append_name)(std::string& out, std::uint64_t value) = nullptr;
};

// Sorted by message.
[[nodiscard]] std::span<const enum_field> enum_fields();
// Those of one message.
[[nodiscard]] std::span<const enum_field> enum_fields_of(std::uint32_t message_id);

// Messages that godwit does not decode and whose bytes are shown to nobody, because they hold a password or a key.
//
// SETUP_SIGNING is not here: it is decoded, and its table marks the key as a secret. Source: MAVLink's common.xml.
// Thread: constants.
inline constexpr std::array<std::uint32_t, 4> withheld_ids{
    5,   // CHANGE_OPERATOR_CONTROL: the password of a ground station
    7,   // AUTH_KEY
    299, // WIFI_CONFIG_AP: the password of a network
    336, // CELLULAR_CONFIG: PIN and password of a modem
};

[[nodiscard]] constexpr bool is_withheld(std::uint32_t id) {
  return std::ranges::find(withheld_ids, id) != withheld_ids.end();
}

// A frame as one JSON object on a line of its own (JSON Lines), for other programs.
//
//   {"time_us":1751373296123456,"system":1,"component":1,"sequence":7,"id":0,"name":"HEARTBEAT","signed":false,
//    "fields":{"type":2,...}}
//
// Time is microseconds since 1970, UTC. Numbers stand as they came, enums too; NaN and infinities are null. A message
// that godwit does not decode has "payload", its bytes as hexadecimal digits, in place of "fields". Secrets are left
// out. Thread: pure.

// Without an end of line.
void append_message_json(std::string& out, std::uint64_t time_us, const io::mavlink::frame_view& frame);

} // namespace godwit::trace_tool
