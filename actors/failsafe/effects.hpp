// What the failsafe wants done, in this order. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "actors/failsafe/reaction.hpp"
#include "actors/failsafe/state.hpp"
#include "io/fields/field_table.hpp"
#include "io/mavlink/enums/vehicle.hpp"
#include "messages/failsafe/types.hpp"
#include "runtime/condition.hpp"

namespace godwit::failsafe {

// To the executor and all who listen, at each change.
struct failsafe_status_changed {
  failsafe_status now;
};

struct override_resolved {
  std::uint64_t request_id = 0;
  override_answer answer;
};

struct guard_resolved {
  std::uint64_t request_id = 0;
  guard_answer answer;
};

// To people.
struct warning {
  io::mavlink::mav_severity severity = io::mavlink::mav_severity::warning;
  std::string text;

  GODWIT_FIELDS(warning, "failsafe.warning", severity, text);
};

// To the journal, in the same turn and not awaited. Comes last, and with each command.
struct remember {
  remembered what;
};

using effect = std::variant<command_vehicle, failsafe_status_changed, override_resolved, guard_resolved, warning,
                            runtime::condition, remember>;
using effects = std::vector<effect>;

} // namespace godwit::failsafe
