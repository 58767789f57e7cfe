// A flight in which one thing goes wrong, in one part of it.
//
// In `ready` the start waits for a station: after what went wrong nobody says anything for a while, and the vehicle
// must stay as it is. Thread: values; fly_disturbed() in one.
#pragma once

#include <array>
#include <functional>
#include <string>

#include "programs/godwit-drill/flights/flight_case.hpp"

namespace godwit::drill {

inline constexpr std::array flight_parts{
    executor::phase::preflight, executor::phase::uploading, executor::phase::ready,      executor::phase::starting,
    executor::phase::flying,    executor::phase::landing,   executor::phase::post_flight};

enum class flight_end {
  as_planned, // the vehicle stands where its mission leads
  or_waits    // or waits for a person: a failsafe or a person has led it away
};

struct disturbed_flight {
  flight_simulation::options wanted = {}; // who flies, and how fast; the start is as the part needs it
  executor::phase part = executor::phase::flying;
  std::string what = {}; // last part of its name
  std::string row = {};  // of the table; empty: the part
  flight_end end = flight_end::as_planned;
  // Why it could not be made; empty: it was.
  std::function<std::string(watched_flight& watched)> disturb = {};

  [[nodiscard]] std::string group() const;
  [[nodiscard]] std::string name() const;
};

// LANDING: or on the way to the last item, with which the vehicle comes down. False: the flight has no such part.
[[nodiscard]] bool reach(flight_simulation& flight, executor::phase part);

[[nodiscard]] flight_case case_of(disturbed_flight each);

// As fast as a vehicle that can be disturbed for a minute in its flight, with the streams of a real one.
[[nodiscard]] flight_simulation::options slow_flight(sim::personality who);

} // namespace godwit::drill
