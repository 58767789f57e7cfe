// Which field of which message holds which enum: the one table from which numbers get their names.
//
// A number without a name has none here either, and is shown as the number that it is. Thread: constants.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace godwit::trace_tool {

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

} // namespace godwit::trace_tool
