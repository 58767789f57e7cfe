// What people do through ground stations: arm, change modes, take off, land, steer, configure.
//
//   kind        godwit has the vehicle            it stands disarmed, and nobody flies    somebody else has it
//   hold        godwit holds                      passed on                               passed on
//   arm         armed already: done; else taken   taken, passed on                        passed on
//   stop, stream, command   taken, passed on      passed on                               passed on
//   configure   refused                           passed on, the checks anew              as the vehicle is: armed or
//   not
//
// "Taken": from then on it is that station's person who has the vehicle, until a hand-back. A vehicle that is armed or
// not heard counts as flying. Whoever has it already is followed by the station that acted last: its start or resume is
// a hand-back, nobody else's. The arm of a station that has just put the vehicle in its mission mode is its start,
// which godwit does (start_by_arming.hpp). Pure. Thread: one at a time.
#pragma once

#include "actors/executor/flight/control_watch.hpp"
#include "actors/executor/flight/operator_control.hpp"
#include "actors/executor/flight/preparation.hpp"
#include "actors/executor/flight/start_by_arming.hpp"
#include "messages/executor/station_act.hpp"

namespace godwit::executor {

// From the arm of a station to the heartbeat that shows it. A start that comes before waits for it.
inline constexpr std::int64_t arming_shows_within_ns = 3'000'000'000;

class station_acts {
public:
  station_acts(flight_context& flight, control_watch& watch, preparation& preparation, operator_control& operators,
               start_by_arming& arming)
      : flight_(flight), watch_(watch), preparation_(preparation), operators_(operators), arming_(arming) {}

  [[nodiscard]] act_answer take(effects& out, const station_act& m, bool has_looked, instant now);

private:
  [[nodiscard]] act_answer configure();
  [[nodiscard]] bool holds(bool has_looked, instant now);
  [[nodiscard]] bool is_done_already(const station_act& m) const;

  flight_context& flight_;
  control_watch& watch_;
  preparation& preparation_;
  operator_control& operators_;
  start_by_arming& arming_;
};

} // namespace godwit::executor
