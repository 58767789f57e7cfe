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

constexpr auto enum_names(act_kind) {
  return io::names<act_kind>({{act_kind::hold, "hold"},
                              {act_kind::go_on, "go_on"},
                              {act_kind::arm, "arm"},
                              {act_kind::take_off, "take_off"},
                              {act_kind::go_to, "go_to"},
                              {act_kind::stop, "stop"},
                              {act_kind::stream, "stream"},
                              {act_kind::command, "command"},
                              {act_kind::configure, "configure"}});
}

struct station_act {
  act_kind kind = act_kind::command;
  station by;
  std::string what;             // for people: "arm", "mode 6"
  std::uint64_t number = 0;     // what follows names it
  bool is_acknowledged = false; // the vehicle answers it
  static constexpr auto fields =
      io::table("executor.station_act", io::field("kind", &station_act::kind), io::field("by", &station_act::by),
                io::field("what", &station_act::what), io::field("number", &station_act::number),
                io::field("is_acknowledged", &station_act::is_acknowledged));
};

enum class act_verdict {
  pass,  // to the vehicle
  done,  // the vehicle is so already: nothing is passed on
  own,   // as a command to godwit: nothing is passed on
  begun, // godwit does it: nothing is passed on, and what came of it follows
  refused
};

constexpr auto enum_names(act_verdict) {
  return io::names<act_verdict>({{act_verdict::pass, "pass"},
                                 {act_verdict::done, "done"},
                                 {act_verdict::own, "own"},
                                 {act_verdict::begun, "begun"},
                                 {act_verdict::refused, "refused"}});
}

struct act_answer {
  act_verdict verdict = act_verdict::refused;
  std::string reason; // sentence for people, when refused
  static constexpr auto fields = io::table("executor.act_answer", io::field("verdict", &act_answer::verdict),
                                           io::field("reason", &act_answer::reason));
};

// To ground_port: what came of an act that was begun. Done: the vehicle has accepted it. Pass: it is a person's by now,
// and goes on to the vehicle after all.
struct act_resolved {
  std::uint64_t number = 0;
  act_answer answer;
  static constexpr auto fields = io::table("executor.act_resolved", io::field("number", &act_resolved::number),
                                           io::field("answer", &act_resolved::answer));
};

// From ground_port: the vehicle has answered a command that was passed on.
struct act_acknowledged {
  std::uint64_t number = 0;
  bool is_refused = false;
  static constexpr auto fields = io::table("executor.act_acknowledged", io::field("number", &act_acknowledged::number),
                                           io::field("is_refused", &act_acknowledged::is_refused));
};

// "station 255/190"
[[nodiscard]] inline std::string name_of(const station& who) {
  return "station " + std::to_string(who.system) + '/' + std::to_string(who.component);
}

} // namespace godwit::executor
