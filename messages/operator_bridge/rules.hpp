// What holds of a request of an operator whatever way it comes. Thread: pure.
#pragma once

#include <cstdint>
#include <string_view>

#include "messages/operator_bridge/control.hpp"

namespace godwit::operator_bridge {

inline constexpr std::uint32_t max_audit_page = 200; // rows that are listed at once

// A hand-over says to whom, and nothing else does.
[[nodiscard]] inline bool names_whom_it_needs(control_act act, std::string_view to) {
  return (act == control_act::hand_over) != to.empty();
}

} // namespace godwit::operator_bridge
