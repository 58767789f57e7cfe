// What a task is made of: steps that the vehicle is brought through one after the other.
//
//   deploy, on the ground                (hold,) note upload, upload
//   the same, behind an infeasible plan  clear it, note upload, upload: a PX4 checks no plan anew that it holds
//   deploy, under way, with plan ids     note upload, upload, guard, mission mode
//   bring back the plan before           (hold,) note upload, upload, guard
//   deploy, under way, without           hold, note upload, upload, guard, choose the first item, mission mode
//   start                                guard, (guided or hold, arm,) start
//   start behind a landing on the way    guard, set home, (arm,) see home, start; ArduPilot has it in the plan
//   hold, resume, come home              that mode; resume of a PX4 in the return of its mission: the return
//   come home by plan                    hold; then as deploy, with the way home
//   stand down                           disarm
//   stand by                             the standing mode, on the ground
//   await arming                         mission mode, on the ground and disarmed
//   free home                            set home where it stands
//
// A step looks before it acts: what the vehicle does already is not asked for. An order that moves the vehicle is given
// once (may_send.hpp); one that the vehicle has refused may be given again, and so may what stops it or moves nothing.
// What the vehicle does not show within its time has failed, and with it the task. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "actors/executor/state.hpp"
#include "messages/flight/flight_mode.hpp"
#include "messages/vehicle_link/command.hpp"

namespace godwit::executor {

struct change_mode {
  flight::mode_kind to = flight::mode_kind::hold;
};
// On the ground: the mode in which it begins nothing when somebody arms it.
struct stand_by {
  bool is_armed = false; // else never when it is
};
// On the ground, disarmed: the mission mode, in which its station arms it next.
struct await_arming {};
struct guard {};      // the failsafe takes over the limits of the flight, as the deployment on the vehicle has them
struct clear_plan {}; // on the ground, disarmed: what the vehicle holds
struct bring_plan {}; // the deployment of the task; its intent is noted by then
// Shown by MISSION_CURRENT, where the vehicle is not in its mission mode and so does not go on at once; by an item
// behind it, where it is a command that moves nothing.
struct set_current_item {
  std::uint16_t sequence = 0;
  std::uint16_t total = 0; // of the plan, as MISSION_CURRENT counts it; 0: not looked at
  bool anew = false;       // ordered as item 0: an ArduPilot goes to its first item and forgets what it has counted
};
struct set_home {}; // to that of the mission, by a command: arming does not move it then
struct see_home {}; // it is there, in the vehicle's own words
struct free_home {};
struct arm {};
struct disarm {};
struct start_plan {
  std::uint16_t sequence = 0;
};

using step = std::variant<change_mode, stand_by, await_arming, guard, clear_plan, bring_plan, set_current_item,
                          set_home, see_home, free_home, arm, disarm, start_plan>;
using steps = std::vector<step>;

inline constexpr int max_tries = 3;                            // of each step
inline constexpr int max_tries_of_lost = 5;                    // of a command without an answer, and of a stop
inline constexpr std::int64_t shown_within_ns = 4'000'000'000; // after the answer: a heartbeat may come 1.5 s late
inline constexpr std::int64_t again_after_ns = 2'500'000'000;  // a stop or what moves nothing, accepted and not shown
inline constexpr std::int64_t lost_after_ns = 1'200'000'000;   // the same without an answer: one heartbeat
inline constexpr std::int64_t look_again_ns = 500'000'000;     // at a vehicle that does not show it yet
inline constexpr std::int64_t look_within_ns = 6'000'000'000;  // longer than vehicle_link waits for a heartbeat
inline constexpr int max_looks = 3;                            // that saw nothing, for one order
inline constexpr std::int64_t prove_again_ns = 500'000'000;    // while another transfer is under way
inline constexpr std::int64_t proof_within_ns =
    30'000'000'000; // and proof_item_ns for each item: a Rover's 600 take 12 s
inline constexpr std::int64_t proof_item_ns = 100'000'000;
// A PX4 checks a plan some 50 ms behind its MISSION_ACK, and tells it with MISSION_CURRENT (1 Hz).
inline constexpr std::int64_t judged_after_ns = 300'000'000;
inline constexpr std::int64_t judged_within_ns = 2'500'000'000;
inline constexpr std::int64_t pause_between_ns = 1'000'000'000; // before the next try of what was refused
inline constexpr std::int64_t stop_answer_ms = 800;             // of a stop: it is obeyed within 2.5 s at 20 % loss
inline constexpr std::int64_t until_heartbeat_ns = 100'000'000; // that vehicle_link has, and we have not: on its way

// An automatic start is begun anew for so long while the vehicle refuses it for now: an ArduPilot that has just been
// switched on is ready by its own checks some 20 s before its position estimate lets it start.
inline constexpr std::int64_t start_patience_ns = 60'000'000'000;

} // namespace godwit::executor
