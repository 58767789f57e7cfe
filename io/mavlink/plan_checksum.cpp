#include "io/mavlink/plan_checksum.hpp"

#include <array>

#include <zlib.h>

#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

std::uint32_t checksum_of(const std::vector<mission_item_int>& items) {
  auto crc = crc32(0, nullptr, 0);
  for (auto each : items) {
    each.target_system = 0;
    each.target_component = 0;
    each.mission_type = 0;
    each.current = 0;
    std::array<std::byte, layout<mission_item_int>::full_length> bytes;
    write_fields(each, bytes.data());
    crc = crc32(crc, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size()));
  }
  if (items.empty())
    return 0;
  return crc == 0 ? 1 : static_cast<std::uint32_t>(crc);
}

} // namespace godwit::io::mavlink
