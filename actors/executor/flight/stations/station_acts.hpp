// What people do through ground stations: arm, change modes, take off, land, steer, configure.
//
//   kind        godwit has the vehicle            it stands disarmed, and nobody flies    somebody else has it
//   hold        in flight: godwit holds           passed on                               passed on
//   go_on       paused: godwit goes on            refused                                 its own station: handed back
//   go_to       a command to godwit               a command to godwit                     passed on
//   arm         armed already: done; else taken   taken, passed on                        passed on
//   take_off    taken, passed on                  taken, passed on                        passed on
//   stop, stream, command   taken, passed on      passed on                               passed on
//   configure   refused                           passed on, the checks anew              by whether it is armed
//
// "Taken": from then on it is that station's person who has the vehicle, until a hand-back. Of a command that the
// vehicle acknowledges that is pending until it has (pending_commands.hpp), and one that it refuses has taken nothing.
// A hold is answered when the vehicle has accepted godwit's, or is known to hold; where somebody takes the vehicle
// before, it is passed on after all. Who has it go on is answered when it is seen to be in its mission. A vehicle that
// is armed or not heard counts as flying. Whoever has it already is followed by the station that acted last: its start
// or resume is a hand-back, nobody else's. The arm of a station that has just put the vehicle in its mission mode is
// its start, which godwit does (start_by_arming.hpp). Pure. Thread: one at a time.
#pragma once

#include <vector>

#include "actors/executor/flight/operator_control.hpp"
#include "actors/executor/flight/preparation.hpp"
#include "actors/executor/flight/stations/start_by_arming.hpp"
#include "actors/executor/flight/watches/control_watch.hpp"
#include "actors/executor/flight/watches/ground_watch.hpp"
#include "messages/executor/station_act.hpp"

namespace godwit::executor {

// From the arm of a station to the heartbeat that shows it. A start that comes before waits for it.
inline constexpr std::int64_t arming_shows_within_ns = 3'000'000'000;
// Holds of stations that godwit is bringing about: one for each of 16 stations, and some that are repeated. The same of
// what goes on.
inline constexpr std::size_t max_awaited_holds = 32;

class station_acts {
public:
  station_acts(flight_context& flight, control_watch& watch, ground_watch& ground, preparation& preparation,
               operator_control& operators, start_by_arming& arming)
      : flight_(flight), watch_(watch), ground_(ground), preparation_(preparation), operators_(operators),
        arming_(arming) {}

  [[nodiscard]] act_answer take(effects& out, const station_act& m, bool has_looked, instant now);
  // The vehicle has answered one that was passed on.
  void on_acknowledged(effects& out, const act_acknowledged& m);
  // It has accepted the hold of godwit.
  void on_hold_accepted(effects& out);
  // What was silent for too long, and what has come of holds.
  void look(effects& out, instant now);

private:
  [[nodiscard]] act_answer configure();
  [[nodiscard]] std::optional<act_answer> hold(const station_act& m, bool has_looked, instant now);
  [[nodiscard]] act_answer pass(effects& out, const station_act& m, instant now);
  [[nodiscard]] bool takes_vehicle(const station_act& m) const;
  [[nodiscard]] bool is_holding() const;
  [[nodiscard]] bool is_asked_to_hold() const;
  [[nodiscard]] bool is_armed_already(const station_act& m) const;
  void accept(effects& out, const station_act& m);
  [[nodiscard]] act_answer go_on(const station_act& m, bool has_looked, instant now);
  [[nodiscard]] bool is_going_on() const;
  void resolve_goings_on(effects& out);

  flight_context& flight_;
  control_watch& watch_;
  ground_watch& ground_;
  preparation& preparation_;
  operator_control& operators_;
  start_by_arming& arming_;
  std::vector<station_act> awaited_holds_;     // that were begun
  std::vector<station_act> awaited_goings_on_; // the same
};

} // namespace godwit::executor
