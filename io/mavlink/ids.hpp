// What is known of each message of MAVLink's `common` and `ardupilotmega` sets by its id: CRC_EXTRA, lengths, name.
//
// It lets the scanner verify the checksum of messages that godwit does not read, so that their bytes are passed over as
// a whole. `slot` numbers the messages from 0 on without gaps, for tables of counters. Thread: constants.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace godwit::io::mavlink {

struct message_info {
  std::uint32_t id = 0;
  std::uint8_t crc_extra = 0;
  std::uint8_t base_length = 0; // of the payload, without extensions
  std::uint8_t full_length = 0; // with them
  std::string_view name;
};

inline constexpr std::size_t known_id_count = 325;

namespace id_table {

inline constexpr std::uint16_t no_slot = 0xFFFF;
inline constexpr std::uint32_t page_size = 256;
inline constexpr std::size_t page_numbers = 204;  // up to the page of the highest id
inline constexpr std::size_t page_count = 10 + 1; // pages in use, and the empty one

extern const std::array<message_info, known_id_count> infos;
extern const std::array<std::uint8_t, page_numbers> pages;
extern const std::array<std::array<std::uint16_t, page_size>, page_count> slots;

} // namespace id_table

[[nodiscard]] inline std::span<const message_info, known_id_count> known_ids() { return id_table::infos; }

// Null if there is no such id.
[[nodiscard]] inline const message_info* find_message(std::uint32_t id) {
  const std::uint32_t page = id / id_table::page_size;
  if (page >= id_table::page_numbers)
    return nullptr;
  const std::uint16_t slot = id_table::slots[id_table::pages[page]][id % id_table::page_size];
  return slot == id_table::no_slot ? nullptr : &id_table::infos[slot];
}

[[nodiscard]] inline std::size_t slot_of(const message_info& info) {
  return static_cast<std::size_t>(&info - id_table::infos.data());
}

} // namespace godwit::io::mavlink
