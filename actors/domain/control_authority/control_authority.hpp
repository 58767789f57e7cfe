// Who has the vehicle. godwit commands only while it is godwit.
//
//                    an order of ours is obeyed
//          ┌──────────────────────────────────────────┐
//          v                                          │
//   ──> godwit ──the plan leads there by itself──> autopilot_end
//          │  ^                                       │
//          │  └── hand-back ──┐                       │
//          ├──another mode, autopilot critical──> autopilot_failsafe    (or it says so within 3 s)
//          └──any other change of the mode──────> person   <──┘
//
// An order names the exact modes that obey it and how long it may take; nothing else is expected. For a
// mode that moves the vehicle a silence does not count: what comes first after it may be its effect. A hold may be that
// of a person who has stopped the vehicle meanwhile. One whose order was not acknowledged is uncertain, and no task
// moves the vehicle out of it by itself. A plan's own change (mode_tables.hpp) is believed once, and only where the
// vehicle says that it is at its end: until MISSION_CURRENT has told so, or has not for 4 s, it is unclear who has the
// vehicle, and nothing may be sent. A person who puts the mode back still has it: only begin() gives it back. An
// ArduPilot's own failsafe is known by its words, which come just before or just after the mode; they only change whose
// a change is called, and never make it godwit's. A plane whose return goes on at once with the landing of its plan
// (RTL_AUTOLAND 2) shows its mission mode, and says so in the same moment: that is part of the return. Executor and
// failsafe have one each, and a person whom either has seen is a person for both. Monotonic nanoseconds. Thread: pure.
//
// CURRENT_MODE (PX4) shows a change between two heartbeats, and also the mode that somebody has asked for last. Where
// the actual mode alone has changed the autopilot's own failsafe has the vehicle, also in a mode that an order of ours
// names, but for the one into which the plan leads when MISSION_CURRENT says that it is complete; where somebody else
// has asked for another mode a person has it, obeyed or not. It has no armed state: a change that may follow from a
// disarm waits for the heartbeat, and until then it is unclear who has the vehicle.
//
// Source: HEARTBEAT (0): custom_mode, system_status; MISSION_CURRENT (42); STATUSTEXT (253); CURRENT_MODE (436).
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "actors/domain/flight_mode/flight_modes.hpp"
#include "messages/flight/plan_end.hpp"

namespace godwit::flight {

enum class holder {
  godwit,
  person,
  autopilot_end,     // a plan has ended as it says; an order takes the vehicle from here
  autopilot_failsafe // the autopilot's own
};

// A vehicle changes its mode within a heartbeat of its answer; a slow link delays both.
inline constexpr std::int64_t order_is_expected_ns = 5'000'000'000;
// Heartbeats come once a second, and one may be lost.
inline constexpr std::int64_t silence_ns = 2'500'000'000;
// MISSION_CURRENT comes once a second, and may be lost.
inline constexpr std::int64_t end_is_told_within_ns = 4'000'000'000;
// A MISSION_CURRENT that comes right after the mode may have been sent before it.
inline constexpr std::int64_t end_is_denied_after_ns = 500'000'000;

// Between the texts of a failsafe and the mode that it changes, either way.
inline constexpr std::int64_t failsafe_is_told_within_ns = 3'000'000'000;
// The same of a breach of its own fence, which is told where the mode stays as well: HEARTBEAT and text come in the
// same millisecond, and a pilot who hears of it needs longer.
inline constexpr std::int64_t breach_is_told_within_ns = 200'000'000;

// A plane that lands by its plan does so in the cycle after that in which it has begun to return, within 10 ms as
// recorded, and says it within 2 ms of the mode. Whoever lands it by a command of his own needs longer.
inline constexpr std::int64_t landing_begins_within_ns = 300'000'000;
inline constexpr std::int64_t landing_is_told_within_ns = 200'000'000;

// That on_text() heeds; it passes over all others.
[[nodiscard]] bool tells_of_authority(std::string_view text);

// CURRENT_MODE, and what the newest heartbeat says of the autopilot itself.
struct told_modes {
  flight_mode actual;
  bool is_critical = false;
  std::uint32_t intended = 0; // by somebody: 0: not told
};

class control_authority {
public:
  // A flight or a start of ours, or a hand-back: whatever the mode is now is ours. What is expected still is.
  void begin(const flight_mode& mode);
  // A new incarnation: the vehicle was left in one of these, or goes into one by an order that is under way. Another
  // mode is judged as a change from them.
  void resume(std::vector<std::uint32_t> left_in, std::int64_t now_ns);
  // The flight is over: nobody is watched until the next begin().
  void end();
  [[nodiscard]] bool is_watching() const { return ours_.has_value(); }

  // Before an order goes out. MODES obey it, in this order. It takes the place of what was expected.
  void expect(std::vector<std::uint32_t> modes, std::int64_t now_ns, std::int64_t until_ns);
  // After what is expected already, whose effect may still come.
  void expect_also(const std::vector<std::uint32_t>& modes, std::int64_t now_ns, std::int64_t until_ns);
  // The order for them was not sent after all.
  void withdraw(const std::vector<std::uint32_t>& modes);
  // The vehicle has acknowledged the newest order, and was in none of its modes before.
  void acknowledge();
  // An operator has seen it held, and commands it.
  void confirm_hold() { is_uncertain_ = false; }
  // Of the plan on the vehicle. What MISSION_CURRENT said before was about another one.
  void set_plan_end(plan_end end);
  // What the plan says of itself counts no more: something else brings the vehicle down.
  void forget_plan_end() { plan_end_.modes.clear(); }

  // It tells its mode, whether that is judged or not.
  void on_heartbeat(std::int64_t now_ns);
  void on_place(std::uint16_t sequence, bool is_complete, std::int64_t now_ns);
  void on_mode(const mode_owner& whose, const flight_mode& mode, bool is_critical, std::int64_t now_ns);
  void on_current_mode(const mode_owner& whose, const told_modes& told, std::int64_t now_ns);
  // Of the autopilot itself (STATUSTEXT).
  void on_text(const mode_owner& whose, std::string_view text, std::int64_t now_ns);
  void on_time(std::int64_t now_ns);
  // Somebody else has seen who took it.
  void take_away(holder by);

  [[nodiscard]] holder who() const { return who_; }
  [[nodiscard]] bool is_ours() const { return who_ == holder::godwit || who_ == holder::autopilot_end; }
  // Who has it is told next: nothing may be sent.
  [[nodiscard]] bool is_unclear() const { return unclear_.has_value() || awaits_heartbeat_; }
  // It holds, and whether by an order or by a person is not known.
  [[nodiscard]] bool is_uncertain() const { return is_uncertain_; }
  [[nodiscard]] bool expects(const flight_mode& mode, std::int64_t now_ns) const;

  // What a record keeps of it.
  [[nodiscard]] const std::optional<flight_mode>& ours() const { return ours_; }
  [[nodiscard]] const std::vector<std::uint32_t>& expected() const { return expected_; }

private:
  struct change {
    flight_mode to;
    std::int64_t since_ns = 0;
    bool is_critical = false;
    bool is_by_itself = false; // nobody has asked for it
    bool is_landing = false;   // if the vehicle says that its return lands by the plan
  };

  void adopt(const flight_mode& mode, holder who);
  void begin_order(std::int64_t now_ns);
  void drop_expected(const flight_mode& mode);
  [[nodiscard]] std::int64_t silences_until(std::int64_t now_ns) const;
  void change_by_itself(const told_modes& told, std::int64_t now_ns);
  [[nodiscard]] bool is_told(std::int64_t since_ns) const;
  void lose(bool is_critical, std::int64_t since_ns);
  [[nodiscard]] bool may_be_landing(const mode_owner& whose, const flight_mode& mode, std::int64_t now_ns) const;
  void judge_landing(std::int64_t now_ns);
  void judge_intention(const mode_owner& whose, const told_modes& told, const std::optional<told_modes>& before,
                       std::int64_t now_ns);
  [[nodiscard]] bool leads_to(const flight_mode& mode) const;
  [[nodiscard]] bool is_at_end() const;

  holder who_ = holder::godwit;
  std::optional<flight_mode> ours_; // none: nobody is watched
  bool was_ordered_ = false;        // the mode that is ours
  bool is_acknowledged_ = false;    // the newest order
  bool is_uncertain_ = false;
  std::vector<std::uint32_t> expected_;
  std::int64_t expected_until_ns_ = 0;
  std::int64_t heard_ns_ = 0;    // or expected, if that is later
  std::int64_t silences_ns_ = 0; // since then: the vehicle was not heard for so long
  plan_end plan_end_;
  std::optional<std::uint16_t> sequence_;
  bool is_complete_ = false;
  std::int64_t place_heard_ns_ = 0;
  std::optional<change> unclear_;
  std::optional<told_modes> told_; // the newest since begin()
  bool awaits_heartbeat_ = false;  // for what has changed the mode that was told
  std::optional<std::int64_t> failsafe_told_ns_;
  std::optional<std::int64_t> breach_told_ns_;
  std::optional<std::int64_t> landing_told_ns_;
  std::optional<std::int64_t> ours_since_ns_; // where it was seen to begin
  std::optional<std::int64_t> taken_ns_;      // by a person, as the mode alone shows
};

} // namespace godwit::flight
