// What each kind of step needs, sends and waits for. step_rules.cpp has one block for each kind, with all of it.
//
//   step                begins while  effect              sends                          is done when
//
//   change_mode         armed (1)     moves, neutral (2)  DO_SET_MODE                    a heartbeat has such a mode
//   safe_ground_mode    disarmed (3)  stops               DO_SET_MODE                    the mode is the safe one
//   await_arming        disarmed      flies the plan      DO_SET_MODE, mission           disarmed in its mission mode
//   guard               any           neutral             guard_mission to the failsafe  the failsafe has answered
//   clear_plan          disarmed      neutral             upload_plan without items      the vehicle has accepted it
//   upload_plan *       any (7)       neutral, moves (4)  upload_plan                    task_uploads.cpp
//   set_current_item *  any (7)       neutral, flies (4)  set_current_item               MISSION_CURRENT shows it (5)
//   restore_home        any           neutral             DO_SET_HOME with a place       the vehicle has accepted it
//   confirm_home        any           neutral             REQUEST_MESSAGE HOME_POSITION  it has the mission's home
//   reset_home          any           neutral             DO_SET_HOME where it stands    the vehicle has accepted it
//   arm                 any           flies the plan      COMPONENT_ARM_DISARM           a heartbeat shows it
//   disarm              it stands     moves               COMPONENT_ARM_DISARM           a heartbeat shows it
//   start_plan *        armed         flies the plan      MISSION_START; PX4: its mode   it flies its mission
//
//   *  its intent is journalled before it is sent, and its end after it
//   1  where the task goes on with a flight   2  mission flies the plan; guided and return move; hold is neutral, or
//   3  unless the step says otherwise            "holds" for a task that goes on out of it
//   5  or the answer, in the mission mode     4  of an armed vehicle in its mission mode
//   6  in its old mode; a hold at the latest after heard_just_now_ns
//   7  on the ground; in a flight armed
//
// The limits follow from the effect and the task:
//
//   what is sent           sent at most           not shown after its answer     without an answer
//   a stop (hold, return)  max_tries_of_lost      again_after_ns                 as it is heard (6)
//   moves, flies           once; if refused       failed after shown_within_ns   failed after shown_within_ns
//                          max_tries
//   neutral                max_tries; lost        again_after_ns                 lost_after_ns
//                          max_tries_of_lost
//   upload_plan            upload_tries.hpp
//
// It fails at the first try that was not done after its last one, at DENIED and UNSUPPORTED, and when it may not begin.
// Pure. Thread: any.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "actors/domain/control_authority/control_authority.hpp"
#include "actors/executor/effects.hpp"
#include "actors/executor/tasks/steps.hpp"
#include "actors/executor/view.hpp"

namespace godwit::executor {

// How often the step under way was sent, and what is known of its last order.
struct step_attempts {
  int tries = 0;
  bool must_ask = false; // what the vehicle shows is older than an order that was given up
  std::int64_t sent_ns = 0;
  std::uint64_t sent_at_heartbeat = 0;
  bool was_in_mission = false; // armed and in its mission mode when it was sent
  bool is_moving = false;      // it moves the vehicle
  bool changes_mode = false;   // the vehicle was in none of its modes; as a repeated one goes out: was just now
  bool was_accepted = false;
  bool was_lost = false;    // no answer came
  std::int64_t lost_ns = 0; // of a stop: when none had come
};

struct step_context {
  const state& durable;
  const vehicle_view& view;
  const flight::control_authority& authority;
  task_kind kind;
  const step_attempts& attempts;
  bool is_armed_by_us = false; // as it was heard last
};

enum class step_effect {
  stops,
  neutral,
  holds,     // for what moves it afterwards, by itself
  moves,     // or lets it move when somebody arms it
  flies_plan // the same, by the plan on the vehicle
};

enum class step_intent { none, start, upload };

struct step_request {
  std::optional<std::vector<std::uint32_t>> modes; // the exact ones that obey it; none: it changes no mode
  decltype(order::what) what;
};

// What stops the vehicle or brings it home does not wait for the disk; nothing else is sent before its reason is there.
// WHAT: null after the last step.
[[nodiscard]] goes urgency_of(task_kind kind, const step* what);
// Sent at once, and again as soon as it seems lost.
[[nodiscard]] bool is_stop(task_kind kind, const step* what);

[[nodiscard]] step_intent intent_of(const step& what);
// Why it may not begin, nor be sent again; empty: it may.
[[nodiscard]] std::string why_not_now(const step& what, const step_context& c);
[[nodiscard]] step_effect effect_of(const step& what, const step_context& c);
// What it sends. Errors: the vehicle has no such order; a sentence.
[[nodiscard]] tl::expected<step_request, std::string> request_of(const step& what, const step_context& c);
[[nodiscard]] bool is_done(const step& what, const step_context& c);
// What shows it comes too late or not at all: the answer counts.
[[nodiscard]] bool is_done_by_answer(const step& what, const step_context& c);
// "the vehicle was asked ..."
[[nodiscard]] std::string description_of(const step& what);

// For HOME_POSITION.
[[nodiscard]] vehicle_link::send_command home_request();

} // namespace godwit::executor
