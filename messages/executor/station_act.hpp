// What a ground station says that a person means, and that the executor hears before the vehicle does.
//
// ground_port asks about each such message and passes it on only with `pass`. By then the vehicle is that person's: the
// executor sends nothing more, and has told the failsafe. It is asked and not told, because the answer is the
// permission. Of a command that the vehicle acknowledges it is pending who has the vehicle until that comes: nothing is
// sent, and a command that the vehicle refuses has taken nothing.
//
//   station_act ──pass──> on to the vehicle ──its COMMAND_ACK──> act_acknowledged
//        └──────begun──> godwit does it ──the vehicle has accepted it, or not──> act_resolved
//
// Thread: plain values.
#pragma once

#include <cstdint>
#include <string>

#include "io/fields/field_table.hpp"
#include "messages/executor/types.hpp"

namespace godwit::executor {

enum class act_kind {
  hold,  // a mode in which the vehicle stays where it is
  go_on, // the mission mode of a flight that is paused
  arm,
  take_off,
  go_to,
  stop,     // disarm, return, land, terminate: it ends what the vehicle does
  stream,   // sticks, positions, attitudes: many a second
  command,  // whatever else moves the vehicle: modes, speeds, heights
  configure // parameters, home, a restart: only of a vehicle that stands disarmed, and it is looked at anew after it
};

GODWIT_ENUM_NAMES(act_kind, hold, go_on, arm, take_off, go_to, stop, stream, command, configure);

struct station_act {
  act_kind kind = act_kind::command;
  station by;
  std::string what;             // for people: "arm", "mode 6"
  std::uint64_t number = 0;     // what follows names it
  bool is_acknowledged = false; // the vehicle answers it
  GODWIT_FIELDS(station_act, "executor.station_act", kind, by, what, number, is_acknowledged);
};

enum class act_verdict {
  pass,  // to the vehicle
  done,  // the vehicle is so already: nothing is passed on
  own,   // as a command to godwit: nothing is passed on
  begun, // godwit does it: nothing is passed on, and what came of it follows
  refused
};

GODWIT_ENUM_NAMES(act_verdict, pass, done, own, begun, refused);

struct act_answer {
  act_verdict verdict = act_verdict::refused;
  std::string reason; // sentence for people, when refused
  GODWIT_FIELDS(act_answer, "executor.act_answer", verdict, reason);
};

// To ground_port: what came of an act that was begun. Done: the vehicle has accepted it. Pass: it is a person's by now,
// and goes on to the vehicle after all.
struct act_resolved {
  std::uint64_t number = 0;
  act_answer answer;
  GODWIT_FIELDS(act_resolved, "executor.act_resolved", number, answer);
};

// From ground_port: the vehicle has answered a command that was passed on.
struct act_acknowledged {
  std::uint64_t number = 0;
  bool is_refused = false;
  GODWIT_FIELDS(act_acknowledged, "executor.act_acknowledged", number, is_refused);
};

// "station 255/190"
[[nodiscard]] inline std::string name_of(const station& who) {
  return "station " + std::to_string(who.system) + '/' + std::to_string(who.component);
}

} // namespace godwit::executor
