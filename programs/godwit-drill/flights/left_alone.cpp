#include "programs/godwit-drill/flights/left_alone.hpp"

#include <string>

#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/vehicle_modes.hpp"

namespace godwit::drill {

bool take_by_hand(flight_simulation& flight) {
  const auto before = flight.vehicle().describe().mode;
  flight.switch_mode(pilot_mode(flight.who()));
  return flight.vehicle().describe().mode != before;
}

void expect_left_alone(watched_flight& watched, bool must_see) {
  constexpr double seen_within_s = 3; // heartbeats come each second, and those of a mode change at once
  constexpr double left_alone_s = 15;
  auto& flight = watched.flight();
  const auto taken_ns = flight.now_ns();
  const auto is_seen = [&] { return executor::needs_hand_back(flight.status().cause); };
  if (flight.run_until(is_seen, seen_within_s)) {
    ++watched.so_far().takeovers;
    watched.note_recovery_since(taken_ns);
  } else {
    watched.expect(must_see ? "godwit has not seen that a person has the vehicle" : "");
  }
  const auto since_ns = flight.now_ns();
  flight.run_for(left_alone_s);
  const auto moves = moves_since(flight, since_ns);
  watched.expect(moves == 0 ? "" : std::to_string(moves) + " commands went out while a person had the vehicle");
}

} // namespace godwit::drill
