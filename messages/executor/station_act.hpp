// What a ground station says that a person means, and that the executor hears before the vehicle does.
//
// ground_port asks about each such message and passes it on only with `pass`. By then the vehicle is that person's: the
// executor sends nothing more, and has told the failsafe. It is asked and not told, because the answer is the
// permission. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>

#include "io/fields/field_table.hpp"
#include "messages/executor/types.hpp"

namespace godwit::executor {

enum class act_kind {
  hold, // a mode in which the vehicle stays where it is
  arm,
  take_off,
  stop,     // disarm, return, land, terminate: it ends what the vehicle does
  stream,   // sticks, positions, attitudes: many a second
  command,  // whatever else moves the vehicle: modes, speeds, heights
  configure // parameters, home, a restart: only of a vehicle that stands disarmed, and it is looked at anew behind it
};

constexpr auto enum_names(act_kind) {
  return io::names<act_kind>({{act_kind::hold, "hold"},
                              {act_kind::arm, "arm"},
                              {act_kind::take_off, "take_off"},
                              {act_kind::stop, "stop"},
                              {act_kind::stream, "stream"},
                              {act_kind::command, "command"},
                              {act_kind::configure, "configure"}});
}

struct station_act {
  act_kind kind = act_kind::command;
  station by;
  std::string what; // for people: "arm", "mode 6"
  static constexpr auto fields = io::table("executor.station_act", io::field("kind", &station_act::kind),
                                           io::field("by", &station_act::by), io::field("what", &station_act::what));
};

enum class act_verdict {
  pass, // to the vehicle
  done, // godwit does it, or the vehicle is so already: nothing is passed on
  refused
};

constexpr auto enum_names(act_verdict) {
  return io::names<act_verdict>(
      {{act_verdict::pass, "pass"}, {act_verdict::done, "done"}, {act_verdict::refused, "refused"}});
}

struct act_answer {
  act_verdict verdict = act_verdict::refused;
  std::string reason; // sentence for people, when refused
  static constexpr auto fields = io::table("executor.act_answer", io::field("verdict", &act_answer::verdict),
                                           io::field("reason", &act_answer::reason));
};

// "station 255/190"
[[nodiscard]] inline std::string name_of(const station& who) {
  return "station " + std::to_string(who.system) + '/' + std::to_string(who.component);
}

} // namespace godwit::executor
