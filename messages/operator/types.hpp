// What an operator can say about a flight, over whatever way: the control socket, a ground station, a page.
//
// Whoever passes it on has authenticated the operator. The answer says whether the command is taken; what comes of it
// is seen in the status of the flight. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "io/fields/field_table.hpp"
#include "messages/mission/place.hpp"

namespace godwit::operators {

enum class command_kind {
  start,       // fly the plan that is ready
  pause,       // hold where it is
  resume,      // continue the mission
  come_home,   // return, and end the mission
  hand_back,   // after a takeover or a failsafe: release the vehicle to the mission
  acknowledge, // fly although preflight report `report` is degraded
  check,       // look at the preflight checks anew
  go_to,       // fly to `place` now, and stay there
  cancel,      // of the last go_to: the mission continues with its first item that is not done
  insert,      // a waypoint at `place`, after item `after`
  end_flight,  // whose vehicle does not come back, or stands: the mission is over, and another vehicle may be taken
  pull         // on the ground: ask the service again, for a mission that it refused or a map whose pull failed
};

GODWIT_ENUM_NAMES(command_kind, start, pause, resume, come_home, hand_back, acknowledge, check, go_to, cancel, insert,
                  end_flight, pull);

struct command {
  operators::command_kind kind = operators::command_kind::pause;
  std::uint32_t report = 0;               // acknowledge
  std::string by;                         // who says it
  std::uint8_t system = 0;                // of the ground station through which it is said; 0: none
  std::uint8_t component = 0;             // the same
  std::optional<mission::position> place; // go_to, insert; metres above the place that the mission counts from
  std::string after;                      // insert: the id of an item; empty: the last one that is done
  std::string state;                      // of the flight that it is meant for, as flight_status has it; empty: any
  static constexpr auto fields = io::table(
      "operator.word", io::field("verb", &command::kind), io::field("report", &command::report),
      io::field("by", &command::by), io::field("system", &command::system), io::field("component", &command::component),
      io::field("place", &command::place), io::field("after", &command::after), io::field("state", &command::state));
};

// Whoever hears of danger may say it, whoever has control: hold, and return.
[[nodiscard]] constexpr bool is_stop(command_kind kind) {
  return kind == command_kind::pause || kind == command_kind::come_home;
}

struct answer {
  bool is_taken = false;
  std::string reason;      // sentence for people; empty when taken
  std::string state = {};  // of the flight, when the command was meant for another one; else empty
  std::string advice = {}; // of one that is taken: what whoever said it should know; nothing else comes of it
  GODWIT_FIELDS(answer, "operator.answer", is_taken, reason, state, advice);
};

} // namespace godwit::operators
