// What of the failsafe must survive a crash: what it has done about which rule, what an operator has overridden, who
// flies, and the limits of the flight, so that it can judge while the executor is down too.
//
// Filters, positions and the like are not here: they fill again within seconds. Times are on the wall clock, because
// the monotonic one begins anew with the computer. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "actors/failsafe/link_ladder.hpp"
#include "actors/failsafe/overrides.hpp"
#include "actors/failsafe/reaction.hpp"
#include "actors/failsafe/rules.hpp"
#include "actors/failsafe/takeover_detector.hpp"
#include "io/fields/field_table.hpp"
#include "messages/failsafe/types.hpp"

namespace godwit::failsafe {

// The executor was asked to bring the vehicle home by a plan.
struct plan_return {
  std::uint64_t number = 0;
  rule why = rule::operator_link; // the highest that wants it
  bool is_taken = false;

  GODWIT_FIELDS(plan_return, "failsafe.plan_return", number, why, is_taken);
  friend bool operator==(const plan_return&, const plan_return&) = default;
};

// The part that changes in flight. It is small: it is written at each change.
struct standing {
  bool in_flight = false;
  std::vector<latch> latches; // at most one for each rule
  std::optional<reaction> reacts;
  std::uint64_t last_number = 0;             // of the commands
  std::vector<standing_override> overridden; // at most one for each rule
  pilot_memory pilot;
  link_memory link;
  std::optional<flight::home_place> home = {};     // as the vehicle told it last
  std::optional<flight::home_place> armed_at = {}; // as it told it first since it was armed
  std::optional<plan_return> by_plan = {};

  GODWIT_FIELDS(standing, "failsafe.standing", in_flight, latches, reacts, last_number, overridden, pilot, link, home,
                armed_at, by_plan);
  friend bool operator==(const standing&, const standing&) = default;
};

// Something of it has changed. The limits can be large: they are there when they are new ones.
struct remembered {
  standing now;
  std::optional<guard_mission> limits = {};
  std::optional<command_vehicle> command = {}; // only read: earlier versions sent it from here

  GODWIT_FIELDS(remembered, "failsafe.remembered", now, limits, command);
};

struct state {
  standing now;
  guard_mission limits;
  static constexpr int version = 1;
  GODWIT_FIELDS(state, "failsafe.state", now, limits);
};

// The durable part: what the core hands over takes the place of what was. Nothing comes of it: a command has gone out
// before, and whether it is still wanted, the vehicle shows.
struct durable_core {
  using state = failsafe::state;
  using event = std::variant<remembered>;
  using effect = std::variant<command_vehicle>;

  [[nodiscard]] static std::vector<effect> apply(state& s, const event& happened, std::int64_t) {
    const auto& what = std::get<remembered>(happened);
    s.now = what.now;
    if (what.limits)
      s.limits = *what.limits;
    return {};
  }
  [[nodiscard]] static std::vector<effect> resume(const state&, std::int64_t) { return {}; }
};

} // namespace godwit::failsafe
