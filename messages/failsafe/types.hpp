// What others say to the failsafe, and what it says. Plain values.
//
// The failsafe acts by itself: none of this is needed for it to act, but for the fences, which it is told before the
// flight and keeps. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/flight/home_place.hpp"
#include "messages/flight/plan_end.hpp"
#include "messages/mission/document.hpp"

namespace godwit::failsafe {

// What may trigger. In the order of their priority: the first is the highest.
enum class rule { battery_critical, fence, battery_low, operator_link };

GODWIT_ENUM_NAMES(rule, battery_critical, fence, battery_low, operator_link);

enum class action {
  return_home, // the autopilot's own return, to its home
  land,
  hold,
  do_land_start // goes on at the landing sequence of the mission
};

constexpr auto enum_names(action) {
  return io::names<action>({{action::return_home, "return"},
                            {action::land, "land"},
                            {action::hold, "hold"},
                            {action::do_land_start, "do_land_start"}});
}

// -- from the executor -----------------------------------------------------------------------------

// The limits of the flight. They replace what was said before, and are kept until others come, over restarts too.
// Heights are what the vehicle reports, above its home: where that is not the place that the mission counts from, who
// tells them has shifted them.
struct guard_mission {
  std::vector<mission::geofence> geofences;
  std::optional<std::uint16_t> land_start; // sequence of DO_LAND_START in the plan on the vehicle, as that counts
  flight::plan_end plan_end;               // of that plan
  // Where a return has to lead; absent in a first flight that begins: to where the vehicle is armed then.
  std::optional<flight::home_place> home = {};
  // Of a first flight that begins where its home is: an arming leaves it there.
  std::optional<flight::home_place> home_before = {};

  GODWIT_FIELDS(guard_mission, "failsafe.guard_mission", geofences, land_start, plan_end, home, home_before);
  friend bool operator==(const guard_mission&, const guard_mission&) = default;
};

// The limits are watched, or they are refused and the ones from before still count.
struct guard_answer {
  bool taken = false;
  std::string reason; // sentence for people; empty when taken

  GODWIT_FIELDS(guard_answer, "failsafe.guard_answer", taken, reason);
};

// The next change into one of these modes is ours: it was commanded. Said before the command goes out. A mode that
// nobody expected is a pilot's.
struct expect_mode {
  std::vector<std::uint32_t> modes; // HEARTBEAT.custom_mode, in the order in which they may come
  std::int64_t lasts_ms = 0;
  bool is_withdrawn = false; // the command was not sent: they are expected no more

  GODWIT_FIELDS(expect_mode, "failsafe.expect_mode", modes, lasts_ms, is_withdrawn);
};

// The executor has seen that a pilot took the vehicle.
struct taken_over {
  static constexpr auto fields = io::table("failsafe.taken_over");
};

// A command of a station goes on to the vehicle, and who has the vehicle is known by its answer: until then, and for so
// long at most, nothing is sent. 0: it was refused, and is as before.
struct command_pending {
  std::int64_t lasts_ms = 0;

  GODWIT_FIELDS(command_pending, "failsafe.command_pending", lasts_ms);
};

struct following {
  bool on = false; // an object is followed

  GODWIT_FIELDS(following, "failsafe.following", on);
};

// -- from an operator, through whoever has checked that it is one -----------------------------------

// A rule does not act until the deadline. What it has done already is lifted: no command goes out, the operator says
// what next.
struct override_rule {
  rule scope = rule::operator_link;
  std::string reason;
  std::int64_t until_ns = 0; // wall clock

  GODWIT_FIELDS(override_rule, "failsafe.override_rule", scope, reason, until_ns);
};

struct override_answer {
  bool taken = false;
  std::string reason; // sentence for people; empty when taken

  GODWIT_FIELDS(override_answer, "failsafe.override_answer", taken, reason);
};

// The vehicle goes back to the mission: after a takeover, or after a failsafe that has done its work. All latches fall,
// and what still holds then acts anew.
struct hand_back {
  static constexpr auto fields = io::table("failsafe.hand_back");
};

// Of failsafe_status::return_asked: it is flown, or why not.
struct return_taken {
  std::uint64_t number = 0;
  bool is_taken = false;
  std::string reason; // sentence for people; empty when taken

  GODWIT_FIELDS(return_taken, "failsafe.return_taken", number, is_taken, reason);
};

// -- what the failsafe says ------------------------------------------------------------------------

enum class reaction_stage {
  under_way, // decided; the vehicle does not show it yet
  failing,   // it does not get through, or the vehicle does not obey; it is tried on
  done       // the vehicle does it
};

GODWIT_ENUM_NAMES(reaction_stage, under_way, failing, done);

struct told_reaction {
  rule why = rule::operator_link; // the highest that wants it
  action what = action::return_home;
  reaction_stage stage = reaction_stage::under_way;

  GODWIT_FIELDS(told_reaction, "failsafe.told_reaction", why, what, stage);
  friend bool operator==(const told_reaction&, const told_reaction&) = default;
};

struct standing_override {
  rule scope = rule::operator_link;
  std::string reason;
  std::int64_t until_ns = 0; // wall clock

  GODWIT_FIELDS(standing_override, "failsafe.standing_override", scope, reason, until_ns);
  friend bool operator==(const standing_override&, const standing_override&) = default;
};

// The vehicle's own return leads elsewhere than to the home of the mission: the executor is to bring it there by a
// plan.
struct asked_return {
  std::uint64_t number = 0; // another one for each
  rule why = rule::operator_link;

  GODWIT_FIELDS(asked_return, "failsafe.asked_return", number, why);
  friend bool operator==(const asked_return&, const asked_return&) = default;
};

// How the failsafe stands. Told as a whole at each change and at each start, so that hearing it twice, or not hearing
// one of two, does no harm. A change that comes with a command is told before the command goes out: who hears it knows
// whose the next mode is.
struct failsafe_status {
  bool in_flight = false;
  bool taken_over = false;             // a pilot has the vehicle: the failsafe warns and sends nothing
  std::optional<told_reaction> reacts; // the flight goes on by this, and the mission ends
  std::vector<rule> latched;           // have had their say in this flight
  std::vector<standing_override> overridden;
  std::uint64_t last_command = 0;                // to the vehicle; each has the next number
  std::optional<asked_return> return_asked = {}; // the executor has not answered it

  GODWIT_FIELDS(failsafe_status, "failsafe.stance", in_flight, taken_over, reacts, latched, overridden, last_command,
                return_asked);
  friend bool operator==(const failsafe_status&, const failsafe_status&) = default;
};

struct get_failsafe_status {
  static constexpr auto fields = io::table("failsafe.get_stance");
};

// -- to itself -------------------------------------------------------------------------------------

// One that was overtaken by a crash has an old number.
struct tick {
  std::uint64_t number = 0;
  GODWIT_FIELDS(tick, "failsafe.tick", number);
};

} // namespace godwit::failsafe
