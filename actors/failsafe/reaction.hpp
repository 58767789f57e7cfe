// What the failsafe does to the vehicle, and how far it got. There is at most one; a higher rule replaces it.
//
//             ┌────────────────it did not get through: again at the next tick────────────────┐
//             v                                                                              │
//   ──> to_send ──command goes out──> in_flight ──refused, not sent──────────────────────────┤
//        ^  │                           │  │  └────no answer──> unsure ──a later heartbeat────┤
//        │  │                           │  └──accepted──> accepted ──not obeyed for 3 s───────┘
//        │  │                           │                    │
//        │  └───────────────────────────┴────────────────────┴──the mode shows it──> done
//        └───────────────────────────a command of ours led out of it───────────────────┘
//
// Whether a command without an answer was obeyed is not known; it goes out again only when a heartbeat that came after
// it was given up shows that it was not. Nothing goes out against a pilot: a mode that is nobody's of ours ends it all
// before (takeover_detector). What else leads out of a return is a command of the executor that was on its way already.
// Thread: plain values.
#pragma once

#include <cstdint>

#include "actors/failsafe/rules.hpp"
#include "io/fields/field_table.hpp"
#include "messages/failsafe/types.hpp"
#include "runtime/effect_kind.hpp"

namespace godwit::failsafe {

enum class reaction_phase { to_send, in_flight, unsure, accepted, done };

GODWIT_ENUM_NAMES(reaction_phase, to_send, in_flight, unsure, accepted, done);

struct reaction {
  rule why = rule::operator_link; // the highest that wants it
  action what = action::return_home;
  reaction_phase phase = reaction_phase::to_send;
  std::uint32_t tries = 0; // how often it went out

  GODWIT_FIELDS(reaction, "failsafe.reaction", why, what, phase, tries);
  friend bool operator==(const reaction&, const reaction&) = default;
};

// A command of the failsafe to the vehicle. It goes out at once: it does not wait for the disk. Thread: plain values.
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
