// Two messages compared by meaning: their JSON, field by field, whatever its order.
//
// A number whose name ends in _ns, _us, _ms or _s, and a text such as "2026-05-04T10:15:30.25Z", is a time and may
// differ by the tolerance, since a handler reads the clock a little later than it began. Thread: pure.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace godwit::runtime {

struct field_difference {
  std::string field;    // "report.item_id", "items[2].seq"; empty: the whole
  std::string expected; // JSON; empty: there is none
  std::string produced;
};

inline constexpr std::size_t max_field_differences = 20;

[[nodiscard]] std::vector<field_difference> differences(std::string_view expected, std::string_view produced,
                                                        std::int64_t tolerance_ns);

} // namespace godwit::runtime
