// What the failsafe wants done, in this order. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "actors/failsafe/command.hpp"
#include "actors/failsafe/state.hpp"
#include "io/fields/field_table.hpp"
#include "io/mavlink/enums/vehicle.hpp"
#include "messages/failsafe/types.hpp"

namespace godwit::failsafe {

// To the executor and all who listen, at each change.
struct stance_changed {
  stance now;
};

struct override_settled {
  std::uint64_t request_id = 0;
  override_answer answer;
};

struct guard_settled {
  std::uint64_t request_id = 0;
  guard_answer answer;
};

// To people.
struct warning {
  io::mavlink::mav_severity severity = io::mavlink::mav_severity::warning;
  std::string text;

  static constexpr auto fields =
      io::table("failsafe.warning", io::field("severity", &warning::severity), io::field("text", &warning::text));
};

enum class wellness { well, impaired, bad };

constexpr auto enum_names(wellness) {
  return io::names<wellness>({{wellness::well, "well"}, {wellness::impaired, "impaired"}, {wellness::bad, "bad"}});
}

// To the health board, at each change.
struct health_changed {
  wellness how = wellness::well;
  std::string reason;

  static constexpr auto fields = io::table("failsafe.health_changed", io::field("how", &health_changed::how),
                                           io::field("reason", &health_changed::reason));
  friend bool operator==(const health_changed&, const health_changed&) = default;
};

// To the journal, in the same turn and not awaited. Comes last, and with each command.
struct remember {
  remembered what;
};

using effect =
    std::variant<command_vehicle, stance_changed, override_settled, guard_settled, warning, health_changed, remember>;
using effects = std::vector<effect>;

} // namespace godwit::failsafe
