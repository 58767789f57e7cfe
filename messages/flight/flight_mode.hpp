// What a flight mode comes down to, whatever number an autopilot gives it.
//
// Every autopilot numbers its modes in its own way. Whoever reads the heartbeat says what a number comes down to
// (actors/domain/flight_mode); the number itself is kept too, because a change between two modes of one kind is a
// change all the same. Thread: plain values. Source: HEARTBEAT (0), custom_mode.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"

namespace godwit::flight {

enum class mode_kind {
  unknown,  // a number that nobody here knows
  manual,   // a person flies
  hold,     // stays where it is, or circles there
  guided,   // goes where another computer tells it
  mission,  // flies the plan that it holds
  take_off, // climbs by itself
  returning,
  landing
};

GODWIT_ENUM_NAMES(mode_kind, unknown, manual, hold, guided, mission, take_off, returning, landing);

struct flight_mode {
  mode_kind kind = mode_kind::unknown;
  std::uint32_t custom_mode = 0; // HEARTBEAT.custom_mode

  GODWIT_FIELDS(flight_mode, "flight.flight_mode", kind, custom_mode);
  friend bool operator==(const flight_mode&, const flight_mode&) = default;
};

} // namespace godwit::flight
