// What a station hears of a plan that it uploads on the ground: what the vehicle says to it, as on a direct line.
//
//   taken here ──> brought to the vehicle ──it has it, or asks for items for judged_after_ns──> taken
//                                         └─it refuses the plan (no room, an item)────────────> no_space, refused:
//                                                                  the plan from before is brought again
//
// A vehicle that has no room says so within a round trip of MISSION_COUNT; how long the items take then is no station's
// business, which waits for some 1.5 s. Where the plan is not brought at once (checks that fail, a person who has the
// vehicle) it is taken here, and what the vehicle makes of it is a text. Live: a crash leaves the station without an
// answer. Pure. Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>

#include "actors/executor/flight/phase_table.hpp"
#include "actors/executor/flight/task_control.hpp"
#include "messages/ground_port/mission.hpp"
#include "messages/vehicle_link/transfer.hpp"

namespace godwit::executor {

class upload_on_ground {
public:
  static constexpr std::int64_t judged_after_ns = 900'000'000;

  upload_on_ground(flight_context& flight, phase_machine& phases) : flight_(flight), phases_(phases) {}

  // The plan of a station is about to take the place of the one that is here. False: it is not brought to a vehicle
  // now, and is taken.
  [[nodiscard]] bool begin(effects& out, std::uint32_t plan_id, instant now);
  // Of the plan of the mission.
  void on_transfer(const vehicle_link::transfer::outcome& outcome);
  // True: the plan from before takes its place again.
  [[nodiscard]] bool look(effects& out, instant now);

private:
  using verdict = ground_port::plan_verdict;
  void resolve(effects& out, verdict how);

  flight_context& flight_;
  phase_machine& phases_;
  struct awaited {
    std::uint32_t plan_id = 0;
    std::int64_t until_ns = 0;
    std::optional<station_plan_taken> before; // what a refusal leaves
    std::optional<verdict> is_refused;
  };
  std::optional<awaited> awaited_;
};

} // namespace godwit::executor
