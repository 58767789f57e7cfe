// Every decision of the failsafes, at a tick of 100 ms.
//
//   heartbeat, landed, position ──> flight_watch: is it in the air? ──┐
//   heartbeat, expect_mode ───────> takeover_detector: who flies? ──────────┤
//   position, asked_guard ────────> fence_watch ──────────┐           │
//   battery ──────────────────────> battery_filter ───────┼─> rules ──┼─> latch_table ─> reaction_driver ─> command
//   operator_heard, following ────> link_ladder ──────────┘           │
//   asked_override, hand_back ────> overrides ────────────────────────┘
//
// The vehicle's own return leads to its home, which somebody may have moved, or an arming on the way. Where it leads
// elsewhere than to the home of the mission (the one that the executor has told, or the one of the arming) the executor
// is asked to bring it there by a plan; where that does not answer or can not, the vehicle's own return is flown, and
// people are told where it leads.
//
// A rule acts on an edge, once, latched, and only in the air (a rover: moving). The cause of an edge is that the rule's
// condition holds, no override stands against it, and the vehicle is in the air; so a condition that began on the
// ground acts at take-off. A lower rule never cancels a higher one. While a pilot has the vehicle the failsafes warn.
// They act while the mission is paused as well; they do not know whether it is.
//
// take() only keeps what it is told; all decisions are made by tick(), in one order, from what is known then. A tick
// may come at any time: a shell ticks as soon as an operator or the executor has said something that must not be lost
// in a crash, and else every tick_ms. What must survive is given out as `remember`. A failsafe that starts again begins
// with that, acts on nothing before it has heard the vehicle, and does not do again what the record or the vehicle's
// mode shows as done. Thread: one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "actors/failsafe/battery_filter.hpp"
#include "actors/failsafe/effects.hpp"
#include "actors/failsafe/events.hpp"
#include "actors/failsafe/fence_watch.hpp"
#include "actors/failsafe/flight_watch.hpp"
#include "actors/failsafe/health.hpp"
#include "actors/failsafe/link_ladder.hpp"
#include "actors/failsafe/overrides.hpp"
#include "actors/failsafe/reaction_driver.hpp"
#include "actors/failsafe/rules.hpp"
#include "actors/failsafe/settings.hpp"
#include "actors/failsafe/state.hpp"
#include "actors/failsafe/takeover_detector.hpp"

namespace godwit::failsafe {

// Along a fence the prediction flickers. It is near again when it was not for so long.
inline constexpr std::int64_t fence_warning_quiet_ms = 5'000;

// Overrides between two ticks. More are dropped: who gets no answer asks again.
inline constexpr std::size_t max_waiting_overrides = 8;

// In which the executor has to say that it flies the way home. It answers in the turn in which it is asked; one that
// has crashed begins anew within a second.
inline constexpr std::int64_t plan_answer_ms = 1'500;

class core {
public:
  core(const settings& configured, const state& restored, instant now);

  void take(const event& heard, instant now);
  [[nodiscard]] effects tick(instant now);

  [[nodiscard]] const runtime::condition& health() const { return health_; }
  // As it was told last, and as the record has it before the first tick.
  [[nodiscard]] const failsafe_status& told() const { return failsafe_status_; }

private:
  // What the senses say at this tick.
  struct view {
    flight_now flight;
    battery_verdict battery;
    fence_verdict fences;
    link_phase link = link_phase::off;
  };

  void handle(const heartbeat& what, instant now);
  void handle(const modes_told& what, instant now);
  void handle(const landed& what, instant now);
  void handle(const position& what, instant now);
  void handle(const home_told& what, instant now);
  void handle(const battery& what, instant now);
  void handle(const mission_current& what, instant now);
  void handle(const autopilot_text& what, instant now);
  void handle(const command_resolved& what, instant now);
  void handle(const operator_heard& what, instant now);
  void handle(const controller_heard& what, instant now);
  void handle(const asked_override& what, instant now);
  void handle(const hand_back& what, instant now);
  void handle(const asked_guard& what, instant now);
  void handle(const expect_mode& what, instant now);
  void handle(const taken_over& what, instant now);
  void handle(const command_pending& what, instant now);
  void handle(const following& what, instant now);
  void handle(const vehicle_link::foreign_act& what, instant now);
  void handle(const return_taken& what, instant now);

  [[nodiscard]] failsafe_status stand(bool in_flight) const;
  [[nodiscard]] view look(instant now);
  void take_limits(effects& out);
  void follow_flight(const view& seen);
  void hear_words(instant now, effects& out);
  void lift(rule scope);
  void watch_pilot(const view& seen, instant now, effects& out);
  [[nodiscard]] bool follows_what_is_wanted() const;
  [[nodiscard]] bool has_cause(rule each, const view& seen) const;
  [[nodiscard]] bool leaves_it_to_pilot() const;
  [[nodiscard]] flight::mode_owner owner() const { return {newest_.autopilot, newest_.what}; }
  void judge_rules(const view& seen, instant now, effects& out);
  [[nodiscard]] const std::optional<flight::home_place>& home_of_mission() const;
  [[nodiscard]] bool returns_elsewhere() const;
  [[nodiscard]] std::string where_it_returns() const;
  void act(rule why, action what, const view& seen, instant now, effects& out);
  void ask_for_plan(rule why, const std::string& cause, instant now, effects& out);
  void resolve_plan(instant now, effects& out);
  void return_without_plan(const std::string& why, effects& out);
  void drive(const view& seen, instant now, effects& out);
  void warn_of_link(const view& seen, effects& out);
  void warn_of_fence(const view& seen, instant now, effects& out);
  void tell_failsafe_status(bool in_flight, effects& out);
  void tell_health(const view& seen, effects& out);
  void keep(bool in_flight, effects& out);

  settings settings_;
  flight_watch flight_;
  takeover_detector pilot_;
  fence_watch fences_;
  battery_filter battery_;
  link_ladder link_;
  overrides overrides_;
  latch_table latches_;
  reaction_driver reaction_;

  heartbeat newest_;
  flight::flight_mode newest_mode_; // of the newest heartbeat, or of a CURRENT_MODE after it
  std::int64_t heartbeat_ns_ = 0;
  std::optional<std::uint16_t> sequence_; // of the newest limits' plan
  std::int64_t sequence_ns_ = 0;
  guard_mission limits_;
  std::optional<flight::home_place> home_;     // as it was told last since it was armed
  std::optional<flight::home_place> armed_at_; // as it was told first
  std::optional<plan_return> by_plan_;
  std::int64_t asked_plan_ns_ = 0;
  std::optional<return_taken> plan_answer_;
  bool limits_refused_ = false; // the newest ones; those from before still count

  // What came since the last tick.
  std::vector<asked_override> wanted_overrides_;
  std::optional<asked_guard> new_limits_;
  struct heard_place {
    mission_current what;
    instant at;
  };
  std::optional<heard_place> place_;
  struct heard_text {
    std::string what;
    instant at;
  };
  static constexpr std::size_t max_texts = 8;
  std::vector<heard_text> texts_; // that tell of authority; until the next tick
  struct heard_modes {
    modes_told what;
    instant at;
  };
  std::optional<heard_modes> modes_;
  std::vector<expect_mode> orders_;
  bool takeover_received_ = false;
  bool hand_back_received_ = false;
  std::int64_t pending_until_ns_ = 0; // who has the vehicle is not known before the answer to a station's command

  // What was said last, so that each thing is said once.
  link_phase said_link_ = link_phase::off;
  std::optional<std::int64_t> fence_ahead_ns_; // when a fence was last seen to be near
  runtime::condition health_{runtime::health_colour::yellow, "nothing has been received yet"};
  failsafe_status failsafe_status_;
  bool has_new_limits_ = false; // not kept yet
  standing kept_;
};

} // namespace godwit::failsafe
