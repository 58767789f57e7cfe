// What of the supervision must survive a crash: in which part the flight is, and what was done about it.
// Thread: plain values.
#pragma once

#include <cstdint>

#include "actors/executor/supervision/part.hpp"
#include "io/fields/field_table.hpp"

namespace godwit::executor::supervision {

// The failsafe is gone in this flight, and what follows was decided: once a flight.
struct failsafe_missed {
  static constexpr auto fields = io::table("executor.supervision.failsafe_missed");
};

struct state {
  std::uint64_t landings = 0;      // ends of flights: what was given up is revived once for each
  bool has_landed = false;         // this mission was flown, and no other one has taken its place
  bool is_failsafe_missed = false; // in this flight
  GODWIT_FIELDS(state, "executor.supervision.state", landings, has_landed, is_failsafe_missed);
};

[[nodiscard]] constexpr part part_of(const state& s, bool in_flight) {
  if (in_flight)
    return part::flight;
  return s.has_landed ? part::after : part::ground;
}

constexpr void apply(state& s, const failsafe_missed&) { s.is_failsafe_missed = true; }

// The flight has begun, or has ended.
constexpr void change_in_flight(state& s, bool is_now) {
  s.has_landed = !is_now;
  s.is_failsafe_missed = false;
  if (!is_now)
    ++s.landings;
}

} // namespace godwit::executor::supervision
