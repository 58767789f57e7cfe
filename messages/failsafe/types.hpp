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

constexpr auto enum_names(rule) {
  return io::names<rule>({{rule::battery_critical, "battery_critical"},
                          {rule::fence, "fence"},
                          {rule::battery_low, "battery_low"},
                          {rule::operator_link, "operator_link"}});
}

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

  static constexpr auto fields =
      io::table("failsafe.guard_mission", io::field("geofences", &guard_mission::geofences),
                io::field("land_start", &guard_mission::land_start), io::field("plan_end", &guard_mission::plan_end),
                io::field("home", &guard_mission::home), io::field("home_before", &guard_mission::home_before));
  friend bool operator==(const guard_mission&, const guard_mission&) = default;
};

// The limits are watched, or they are refused and the ones from before still count.
struct guard_answer {
  bool taken = false;
  std::string reason; // sentence for people; empty when taken

  static constexpr auto fields = io::table("failsafe.guard_answer", io::field("taken", &guard_answer::taken),
                                           io::field("reason", &guard_answer::reason));
};

// The next change into one of these modes is ours: it was commanded. Said before the command goes out. A mode that
// nobody expected is a pilot's.
struct expect_mode {
  std::vector<std::uint32_t> modes; // HEARTBEAT.custom_mode, in the order in which they may come
  std::int64_t lasts_ms = 0;
  bool is_withdrawn = false; // the command was not sent: they are expected no more

  static constexpr auto fields =
      io::table("failsafe.expect_mode", io::field("modes", &expect_mode::modes),
                io::field("lasts_ms", &expect_mode::lasts_ms), io::field("is_withdrawn", &expect_mode::is_withdrawn));
};

// The executor has seen that a pilot took the vehicle.
struct taken_over {
  static constexpr auto fields = io::table("failsafe.taken_over");
};

// A command of a station goes on to the vehicle, and who has the vehicle is known by its answer: until then, and for so
// long at most, nothing is sent. 0: it was refused, and is as before.
struct command_pending {
  std::int64_t lasts_ms = 0;

  static constexpr auto fields =
      io::table("failsafe.command_pending", io::field("lasts_ms", &command_pending::lasts_ms));
};

struct following {
  bool on = false; // an object is followed

  static constexpr auto fields = io::table("failsafe.following", io::field("on", &following::on));
};

// -- from an operator, through whoever has checked that it is one -----------------------------------

// A rule does not act until the deadline. What it has done already is lifted: no command goes out, the operator says
// what next.
struct override_rule {
  rule scope = rule::operator_link;
  std::string reason;
  std::int64_t until_ns = 0; // wall clock

  static constexpr auto fields =
      io::table("failsafe.override_rule", io::field("scope", &override_rule::scope),
                io::field("reason", &override_rule::reason), io::field("until_ns", &override_rule::until_ns));
};

struct override_answer {
  bool taken = false;
  std::string reason; // sentence for people; empty when taken

  static constexpr auto fields = io::table("failsafe.override_answer", io::field("taken", &override_answer::taken),
                                           io::field("reason", &override_answer::reason));
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

  static constexpr auto fields =
      io::table("failsafe.return_taken", io::field("number", &return_taken::number),
                io::field("is_taken", &return_taken::is_taken), io::field("reason", &return_taken::reason));
};

// -- what the failsafe says ------------------------------------------------------------------------

enum class reaction_stage {
  under_way, // decided; the vehicle does not show it yet
  failing,   // it does not get through, or the vehicle does not obey; it is tried on
  done       // the vehicle does it
};

constexpr auto enum_names(reaction_stage) {
  return io::names<reaction_stage>(
      {{reaction_stage::under_way, "under_way"}, {reaction_stage::failing, "failing"}, {reaction_stage::done, "done"}});
}

struct told_reaction {
  rule why = rule::operator_link; // the highest that wants it
  action what = action::return_home;
  reaction_stage stage = reaction_stage::under_way;

  static constexpr auto fields =
      io::table("failsafe.told_reaction", io::field("why", &told_reaction::why),
                io::field("what", &told_reaction::what), io::field("stage", &told_reaction::stage));
  friend bool operator==(const told_reaction&, const told_reaction&) = default;
};

struct standing_override {
  rule scope = rule::operator_link;
  std::string reason;
  std::int64_t until_ns = 0; // wall clock

  static constexpr auto fields =
      io::table("failsafe.standing_override", io::field("scope", &standing_override::scope),
                io::field("reason", &standing_override::reason), io::field("until_ns", &standing_override::until_ns));
  friend bool operator==(const standing_override&, const standing_override&) = default;
};

// The vehicle's own return leads elsewhere than to the home of the mission: the executor is to bring it there by a
// plan.
struct asked_return {
  std::uint64_t number = 0; // another one for each
  rule why = rule::operator_link;

  static constexpr auto fields = io::table("failsafe.asked_return", io::field("number", &asked_return::number),
                                           io::field("why", &asked_return::why));
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

  static constexpr auto fields =
      io::table("failsafe.stance", io::field("in_flight", &failsafe_status::in_flight),
                io::field("taken_over", &failsafe_status::taken_over), io::field("reacts", &failsafe_status::reacts),
                io::field("latched", &failsafe_status::latched), io::field("overridden", &failsafe_status::overridden),
                io::field("last_command", &failsafe_status::last_command),
                io::field("return_asked", &failsafe_status::return_asked));
  friend bool operator==(const failsafe_status&, const failsafe_status&) = default;
};

struct get_failsafe_status {
  static constexpr auto fields = io::table("failsafe.get_stance");
};

// -- to itself -------------------------------------------------------------------------------------

// One that was overtaken by a crash has an old number.
struct tick {
  std::uint64_t number = 0;
  static constexpr auto fields = io::table("failsafe.tick", io::field("number", &tick::number));
};

} // namespace godwit::failsafe
