// A command of the failsafe to the vehicle. It goes out at once: it does not wait for the disk. Thread: plain values.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"
#include "messages/failsafe/types.hpp"
#include "runtime/effect_kind.hpp"

namespace godwit::failsafe {

struct command_vehicle {
  static constexpr auto goes_out = runtime::effect_kind::at_once;
  std::uint64_t number = 0; // rises with each command, also over a restart
  rule why = rule::operator_link;
  action what = action::return_home;
  std::uint8_t confirmation = 0; // 0 at the first try, one more at each further one

  GODWIT_FIELDS(command_vehicle, "failsafe.command_vehicle", number, why, what, confirmation);
  friend bool operator==(const command_vehicle&, const command_vehicle&) = default;
};

} // namespace godwit::failsafe
