// Which messages are wanted, by name.
//
// Names are those of MAVLink in capitals or not, `*` stands for any letters, as in MISSION_*; several are parted by
// commas. UNKNOWN_<id> are messages whose id is in no table. None given: all are wanted. Errors: a sentence that names
// what was mistyped and what was probably meant. Thread: a value.
#pragma once

#include <bitset>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "io/mavlink/ids.hpp"

namespace godwit::trace_tool {

// True if PATTERN, in which `*` stands for any letters, is all of TEXT.
[[nodiscard]] bool matches(std::string_view pattern, std::string_view text);

class name_filter {
public:
  [[nodiscard]] static tl::expected<name_filter, std::string> parse(std::span<const std::string> lists);

  [[nodiscard]] bool wants(std::uint32_t id) const;

private:
  [[nodiscard]] tl::expected<void, std::string> add(std::string pattern);

  bool is_all_ = true;
  std::bitset<io::mavlink::known_id_count> known_; // by slot, see io/mavlink/ids.hpp
  std::vector<std::string> unknown_;               // patterns for the names UNKNOWN_<id>
};

} // namespace godwit::trace_tool
