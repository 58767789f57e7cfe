// What a task is made of: steps that the vehicle is brought through one after the other.
//
//   deploy, on the ground               (safe ground mode,) upload
//   the same, after an infeasible plan  clear it, upload: a PX4 checks no plan anew that it holds
//   deploy, in flight, with plan ids    upload, guard, mission mode
//   upload the plan before again        (guard, hold,) upload, guard
//   deploy, in flight, without          guard, hold, upload, guard, set the first item, mission mode
//   start                               guard, (guided or safe ground mode, arm,) start
//   start after a landing on the way    guard, restore home, (arm,) confirm home, start; ArduPilot has it in the plan
//   hold, resume, come home             that mode; resume of a PX4 in the return of its mission: the return
//   come home by plan                   hold; then as deploy, with the way home
//   stand down                          disarm
//   stand by                            safe ground mode
//   await arming                        mission mode, on the ground and disarmed
//   free home                           reset home
//
// A step that is done already is not sent. What each kind sends and waits for: step_rules.hpp. Thread: plain values.
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
struct safe_ground_mode {
  bool is_armed = false; // false: fails when it is armed
};
// On the ground, disarmed: the mission mode, in which its station arms it next.
struct await_arming {};
struct guard {};       // the failsafe takes over the limits of the flight, as the plan on the vehicle has them
struct clear_plan {};  // on the ground, disarmed: what the vehicle holds
struct upload_plan {}; // that of the task
// Where it is a command that moves nothing, the vehicle shows a later item.
struct set_current_item {
  std::uint16_t sequence = 0;
  std::uint16_t total = 0; // of the plan, as MISSION_CURRENT counts it; 0: not compared
  bool anew = false;       // ordered as item 0: an ArduPilot goes to its first item and forgets what it has counted
};
struct restore_home {}; // to that of the mission, by a command: arming does not move it then
struct confirm_home {}; // the vehicle reports that one
struct reset_home {};   // to where it stands
struct arm {};
struct disarm {};
struct start_plan {
  std::uint16_t sequence = 0;
};

using step = std::variant<change_mode, safe_ground_mode, await_arming, guard, clear_plan, upload_plan, set_current_item,
                          restore_home, confirm_home, reset_home, arm, disarm, start_plan>;
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
// A PX4 checks a plan some 50 ms after its MISSION_ACK, and reports it with MISSION_CURRENT (1 Hz).
inline constexpr std::int64_t judged_after_ns = 300'000'000;
inline constexpr std::int64_t judged_within_ns = 2'500'000'000;
inline constexpr std::int64_t pause_between_ns = 1'000'000'000; // before the next try of what was refused
inline constexpr std::int64_t stop_answer_ms = 800;             // of a stop: done within 2.5 s at 20 % loss
inline constexpr std::int64_t heard_just_now_ns = 200'000'000;  // as long as copies of an order go out
inline constexpr std::int64_t until_heartbeat_ns = 100'000'000; // that vehicle_link has, and we have not: on its way

// An automatic start is begun anew for so long while the vehicle refuses it for now: an ArduPilot that has just been
// switched on is ready by its own checks some 20 s before its position estimate lets it start.
inline constexpr std::int64_t start_patience_ns = 60'000'000'000;

} // namespace godwit::executor
