// What the vehicle does between two commands: it stands, drives, climbs, follows its mission, comes back, lands.
//
// The autopilot (modes, arming, MAVLink) tells it what to do; flight moves the body in small steps and says what
// happened. It knows no MAVLink but the items of the mission, and no time but the world's.
//
//   flight f(multirotor_craft(), home);
//   f.mission().load(items);
//   f.mission().start(0);
//   f.set_task(task::follow_mission{});
//   ... at f.next_step_ns(), or whenever: for (const auto& each : f.advance(world_ns)) ...
//
// Deterministic: the same calls at the same times give the same bytes. The ground is level, at home's altitude when the
// flight is made. A rover takes LAND for `drive there and stop`; a multirotor that is told to go somewhere while it
// stands on the ground takes off first, a fixed wing stays there. Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "programs/godwit-sim/vehicle/flight/craft.hpp"
#include "programs/godwit-sim/vehicle/flight/maneuver.hpp"
#include "programs/godwit-sim/vehicle/flight/mission_pilot.hpp"
#include "programs/godwit-sim/vehicle/flight/mission_run.hpp"
#include "programs/godwit-sim/vehicle/flight/mover.hpp"
#include "programs/godwit-sim/vehicle/world/body.hpp"
#include "programs/godwit-sim/vehicle/world/position.hpp"

namespace godwit::sim {

// What a vehicle is told to do; each task replaces the one before. Thread: values.
struct task {
  struct rest { // motors off
    bool operator==(const rest&) const = default;
  };
  struct hold { // a rover stops; in the air it stays where it is, a wing on circles; on the ground it stays there
    bool operator==(const hold&) const = default;
  };
  struct go { // and hold there
    position to;
    double speed_mps = 0; // 0: the craft's own
    bool operator==(const go&) const = default;
  };
  struct climb {           // take off, or change altitude, above where it is; then hold
    double altitude_m = 0; // above mean sea level
    bool operator==(const climb&) const = default;
  };
  struct land { // where it is
    bool operator==(const land&) const = default;
  };
  struct come_back { // in the air: to the return altitude, home, land (a wing circles); a rover: home, and stop
    bool operator==(const come_back&) const = default;
  };
  struct follow_mission { // as mission() says; holds while it is idle and when it is complete
    bool operator==(const follow_mission&) const = default;
  };
  struct coast { // hands off in a manual mode: it comes to a stop; a wing in the air circles, as its pilot would
    bool operator==(const coast&) const = default;
  };
  using any = std::variant<rest, hold, go, climb, land, come_back, follow_mission, coast>;
};

class flight {
public:
  flight(const craft& what, const position& home);

  // Moves the body to the time NOW, in steps of at most craft::step_ns. In order. What a vehicle at rest is told takes
  // effect now, and not at the time of the last call.
  [[nodiscard]] happenings advance(std::int64_t world_ns);

  // The task that it has already is left as it is, with what it has done of it.
  void set_task(const task::any& what);
  [[nodiscard]] const task::any& current_task() const { return task_; }
  [[nodiscard]] mission_run& mission() { return pilot_.run(); }
  [[nodiscard]] const mission_run& mission() const { return pilot_.run(); }
  void keep_trigger() { pilot_.keep_trigger(); } // these as mission_pilot
  void change_speed(double speed_mps) { pilot_.change_speed(speed_mps); }
  void look_at(const std::optional<position>& where) { pilot_.look_at(where); }
  [[nodiscard]] const std::optional<position>& region_of_interest() const { return pilot_.region_of_interest(); }

  [[nodiscard]] const body& where() const { return mover_.where(); }
  [[nodiscard]] const position& home() const { return home_; }
  void set_home(const position& where) { home_ = where; }
  void set_rally_points(std::vector<position> places) { mover_.set_rally_points(std::move(places)); }
  [[nodiscard]] double altitude_above_home_m() const { return where().where.altitude_m - home_.altitude_m; }
  [[nodiscard]] bool is_in_air() const { return mover_.is_in_air(); } // never for a rover
  [[nodiscard]] std::uint8_t vtol_state() const { return mover_.vtol_state(); }
  [[nodiscard]] bool is_moving() const { return where().ground_speed_mps > 0.1 || where().climb_mps != 0; }
  // The time of the next step while it moves or waits; a vehicle at rest needs none, and the answer is never_ns.
  [[nodiscard]] std::int64_t next_step_ns() const;
  static constexpr std::int64_t never_ns = INT64_MAX;
  void block(bool is_blocked) { mover_.block(is_blocked); }
  // How many steps it has taken.
  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  // Everything stops at once, as when the power comes back: on the ground, where it is. The mission is idle.
  void restart();

private:
  void step(double step_s, happenings& said);
  void begin_task();
  [[nodiscard]] bool is_settled() const;

  mover mover_;
  position home_;
  task::any task_ = task::rest{};
  mission_pilot pilot_;
  maneuver maneuver_; // of the tasks that are one
  bool is_task_done_ = true;
  bool is_resting_ = true; // since the last call of advance()
  std::int64_t time_ns_ = 0;
  std::uint64_t steps_ = 0;
};

} // namespace godwit::sim
