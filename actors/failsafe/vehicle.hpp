// What a failsafe has to know of the vehicle: what it is, what its mode comes down to, and whether it stands.
//
// Every autopilot numbers its modes in its own way. Whoever reads the heartbeat says what a number comes down to; the
// number itself is kept too, because a change between two modes of one kind is a change all the same. Thread: plain
// values.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"
#include "io/mavlink/enums/vehicle.hpp"

namespace godwit::failsafe {

// What lands when it has no power left, what must go on flying, and what can simply stop.
enum class vehicle_class { unknown, multirotor, fixed_wing, rover };

constexpr auto enum_names(vehicle_class) {
  return io::names<vehicle_class>({{vehicle_class::unknown, "unknown"},
                                   {vehicle_class::multirotor, "multirotor"},
                                   {vehicle_class::fixed_wing, "fixed_wing"},
                                   {vehicle_class::rover, "rover"}});
}

// A vertical take-off aeroplane counts as an aeroplane: it comes home on its wings.
[[nodiscard]] vehicle_class class_of(io::mavlink::mav_type type);

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

constexpr auto enum_names(mode_kind) {
  return io::names<mode_kind>({{mode_kind::unknown, "unknown"},
                               {mode_kind::manual, "manual"},
                               {mode_kind::hold, "hold"},
                               {mode_kind::guided, "guided"},
                               {mode_kind::mission, "mission"},
                               {mode_kind::take_off, "take_off"},
                               {mode_kind::returning, "returning"},
                               {mode_kind::landing, "landing"}});
}

struct flight_mode {
  mode_kind kind = mode_kind::unknown;
  std::uint32_t custom_mode = 0; // HEARTBEAT.custom_mode

  static constexpr auto fields = io::table("failsafe.flight_mode", io::field("kind", &flight_mode::kind),
                                           io::field("custom_mode", &flight_mode::custom_mode));
  friend bool operator==(const flight_mode&, const flight_mode&) = default;
};

// As EXTENDED_SYS_STATE says it.
enum class landed_state { unknown, on_ground, in_air, taking_off, landing };

} // namespace godwit::failsafe
