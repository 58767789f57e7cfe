// The odometer's decisions: which kilometre is full, and what a reset answers. Pure: time comes in with the event.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

#include "tests/example/actors/odometer/state.hpp"
#include "tests/example/messages/odometer/types.hpp"

namespace godwit::odometer {

struct core {
  using state = odometer::state;
  using event = std::variant<moved, reset>;           // what changes the state
  using effect = std::variant<milestone, reset_done>; // what comes of it

  static constexpr std::uint64_t milestone_m = 1000;

  [[nodiscard]] static std::vector<effect> apply(state& s, const event& happened, std::int64_t now_ns);
  [[nodiscard]] static std::vector<effect> resume(const state& s, std::int64_t now_ns);
  [[nodiscard]] static tl::expected<nlohmann::json, std::string> migrate(nlohmann::json old, int from_version);
};

} // namespace godwit::odometer
