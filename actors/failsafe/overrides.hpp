// What operators have overridden: each with a scope, a reason and a deadline.
//
// While it lasts the rule does not act; at the deadline it counts again, and acts at once when its cause is still
// there. A critical battery can not be overridden. The deadline is the operator's, on the wall clock; what is left of
// it is measured on the monotonic one, so that a correction of the clock neither ends nor prolongs it.
// Errors: a refusal is a sentence for people. Thread: pure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "actors/failsafe/events.hpp"
#include "actors/failsafe/rules.hpp"
#include "messages/failsafe/types.hpp"

namespace godwit::failsafe {

inline constexpr std::int64_t max_override_ms = 3'600'000; // one that nobody remembers protects nobody
inline constexpr std::size_t max_override_reason = 256;    // bytes; the rest is cut off

class overrides {
public:
  overrides(const std::vector<standing_override>& restored, instant now);

  // It replaces the one before for the same scope.
  [[nodiscard]] tl::expected<void, std::string> take(const override_rule& wanted, instant now);
  void expire(instant now);

  [[nodiscard]] bool holds(rule scope) const { return slots_.at(index_of(scope)).has_value(); }
  [[nodiscard]] std::vector<standing_override> all() const;

private:
  struct slot {
    standing_override what;
    std::int64_t until_monotonic_ns = 0;
  };

  std::array<std::optional<slot>, rules.size()> slots_;
};

} // namespace godwit::failsafe
