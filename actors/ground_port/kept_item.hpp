// An item of a plan as it is kept on the disk: exactly as it came.
//
// Its id is a checksum of every bit, and JSON carries neither infinities nor the bits of a NaN (many stations send NaN
// for "any yaw"). So the floats are kept as the integers with the same bits. Thread: values.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "io/fields/field_table.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"

namespace godwit::ground_port {

struct kept_item {
  std::uint16_t command = 0;
  std::uint8_t frame = 0;
  std::uint8_t current = 0;
  std::uint8_t autocontinue = 0;
  std::uint8_t mission_type = 0;
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::array<std::uint32_t, 5> float_bits{}; // param1 to param4, z
  GODWIT_FIELDS(kept_item, "ground_port.kept_item", command, frame, current, autocontinue, mission_type, x, y,
                float_bits);
};

// Without the address; the sequence of an item is its place in the list.
[[nodiscard]] std::vector<kept_item> keep(const std::vector<io::mavlink::mission_item_int>& items);
[[nodiscard]] std::vector<io::mavlink::mission_item_int> restore(const std::vector<kept_item>& items);

} // namespace godwit::ground_port
