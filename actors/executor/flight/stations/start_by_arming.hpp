// A start by the mission mode of a vehicle that stands disarmed, whose station arms it next: so QGroundControl starts a
// PX4, and so do people who type "mode auto" and "arm throttle".
//
//   mission mode of a station, all is ready but the arming ──> disarmed, the vehicle is put in its mission mode
//     ├── within arm_within_ns that station's arm ──> godwit arms and starts it, as with arm_on_start
//     ├── anybody else's arm through a station    ──> refused: it would start what another one has prepared
//     ├── another mode, take-off, sticks, ...     ──> that person's, as always
//     └── nothing                                 ──> it is taken out of its mission mode again (flight_end.hpp)
//
// What is awaited is in memory alone: a new incarnation takes the vehicle out of its mission mode. Pure. Thread: one at
// a time.
#pragma once

#include <cstdint>
#include <optional>

#include "actors/executor/flight/preparation.hpp"
#include "actors/executor/flight/task_control.hpp"
#include "messages/executor/station_act.hpp"

namespace godwit::executor {

class start_by_arming {
public:
  // Stations that look for the mode first arm within 5 s; who types takes longer.
  static constexpr std::int64_t arm_within_ns = 15'000'000'000;

  start_by_arming(flight_context& flight, task_control& tasks, preparation& preparation)
      : flight_(flight), tasks_(tasks), preparation_(preparation) {}

  // SEQUENCE: where the plan is started.
  void begin(effects& out, const start_mission& asked, std::uint16_t sequence, instant now);
  // Nothing: what the station does is not about it.
  [[nodiscard]] std::optional<act_answer> take(effects& out, const station_act& m, instant now);
  // It was waited for long enough, or something else has come of the vehicle.
  void look(effects& out, instant now);

private:
  [[nodiscard]] act_answer start(effects& out, instant now);

  flight_context& flight_;
  task_control& tasks_;
  preparation& preparation_;
};

} // namespace godwit::executor
