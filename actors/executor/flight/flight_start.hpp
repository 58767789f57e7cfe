// Starts: by a ground station, by an operator, by itself; and one that came through when nobody waited for it any more.
// Pure. Thread: one at a time.
#pragma once

#include "actors/executor/flight/preparation.hpp"
#include "actors/executor/flight/stations/part_choice.hpp"
#include "actors/executor/flight/stations/start_by_arming.hpp"
#include "actors/executor/flight/watches/control_watch.hpp"

namespace godwit::executor {

class flight_start {
public:
  // Nothing begins by itself so long after somebody else has commanded the vehicle: he stands beside it.
  static constexpr std::int64_t person_acts_ns = 10'000'000'000;

  flight_start(flight_context& flight, phase_machine& phases, task_control& tasks, control_watch& watch,
               preparation& prepared, part_choice& parts, start_by_arming& arming)
      : flight_(flight), phases_(phases), tasks_(tasks), watch_(watch), preparation_(prepared), parts_(parts),
        arming_(arming) {}

  // The one that is wanted.
  [[nodiscard]] bool begin_wanted(effects& out, instant now);
  // The flight is ready, and nobody has asked.
  [[nodiscard]] bool begin_by_itself(effects& out, instant now);
  // Our plan is flown, and nobody here has started it: a start whose sender died came through, or somebody else has
  // said it, also before he has handed the vehicle back. It is followed, and guarded; nothing else is sent.
  [[nodiscard]] bool follow(effects& out, instant now);
  // Somebody else has the vehicle: who waits for a start is told.
  void refuse(effects& out, const std::string& why);

private:
  void begin(effects& out, std::optional<std::uint64_t> key, std::uint16_t sequence);
  void begin_in_flight(effects& out, const start_mission& asked, instant now);
  void begin_in_air(effects& out, const start_mission& asked);
  [[nodiscard]] std::string why_start_waits() const;
  [[nodiscard]] bool waits_for_arming(instant now) const;
  [[nodiscard]] std::string why_not_in_flight() const;
  [[nodiscard]] std::uint16_t first_sequence() const;
  [[nodiscard]] std::optional<std::uint16_t> sequence_of(const start_mission& asked) const;
  void begin_asked(effects& out, const start_mission& asked, instant now);
  [[nodiscard]] std::string why_not(effects& out, instant now);
  [[nodiscard]] std::string why_not_ready(effects& out, instant now);

  flight_context& flight_;
  phase_machine& phases_;
  task_control& tasks_;
  control_watch& watch_;
  preparation& preparation_;
  part_choice& parts_;
  start_by_arming& arming_;
};

} // namespace godwit::executor
