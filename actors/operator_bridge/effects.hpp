// What comes of what operator_bridge decides, in the order in which it is to be done. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "actors/operator_bridge/state.hpp"

namespace godwit::operator_bridge {

// To be put into the durable state, at once.
struct note {
  durable_core::event what;
};

// To the executor. A stop goes before all is written; else release() is asked again when it is on the disk.
struct hand_over {
  std::uint64_t number = 0;
  operators::command what;
  bool at_once = false;
};

struct reply {
  std::uint64_t request = 0;
  command_answer answer;
  bool waits = true; // until all that was decided is on the disk
};

// A session, or the right of a program to speak by its token.
struct session_over {
  std::string session;
};

using effect = std::variant<note, hand_over, reply, session_over>;
using effects = std::vector<effect>;

} // namespace godwit::operator_bridge
