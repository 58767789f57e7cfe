// What an operator can say about a flight, over whatever way: the control socket, a ground station, a page.
//
// Whoever passes it on has authenticated the operator. The answer says whether the word is taken; what comes of it is
// seen in the standing of the flight. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "io/fields/field_table.hpp"
#include "messages/mission/place.hpp"

namespace godwit::operator_words {

enum class verb {
  start,       // fly the plan that is ready
  pause,       // hold where it is
  resume,      // go on with the mission
  come_home,   // return, and end the mission
  hand_back,   // after a takeover or a failsafe: the mission has the vehicle again
  acknowledge, // fly although preflight report `report` is degraded
  check,       // look at the preflight checks anew
  go_to,       // fly to `place` now, and stay there
  cancel,      // of the last go_to: the mission goes on with its first item that is not done
  insert       // a waypoint at `place`, behind item `after`
};

constexpr auto enum_names(verb) {
  return io::names<verb>({{verb::start, "start"},
                          {verb::pause, "pause"},
                          {verb::resume, "resume"},
                          {verb::come_home, "come_home"},
                          {verb::hand_back, "hand_back"},
                          {verb::acknowledge, "acknowledge"},
                          {verb::check, "check"},
                          {verb::go_to, "go_to"},
                          {verb::cancel, "cancel"},
                          {verb::insert, "insert"}});
}

struct word {
  operator_words::verb verb = operator_words::verb::pause;
  std::uint32_t report = 0;               // acknowledge
  std::string by;                         // who says it
  std::optional<mission::position> place; // go_to, insert; metres above the place that the mission counts from
  std::string after;                      // insert: the id of an item; empty: the last one that is done
  static constexpr auto fields =
      io::table("operator.word", io::field("verb", &word::verb), io::field("report", &word::report),
                io::field("by", &word::by), io::field("place", &word::place), io::field("after", &word::after));
};

struct answer {
  bool is_taken = false;
  std::string reason; // sentence for people; empty when taken
  static constexpr auto fields =
      io::table("operator.answer", io::field("is_taken", &answer::is_taken), io::field("reason", &answer::reason));
};

} // namespace godwit::operator_words
