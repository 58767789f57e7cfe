// A command as stations send it: COMMAND_LONG to the autopilot 1/1. Thread: any.
#pragma once

#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages.hpp"

namespace godwit::drill {

[[nodiscard]] inline io::mavlink::command_long autopilot_command(io::mavlink::mav_cmd what, float param1, float param2,
                                                                 float param3, float param7) {
  io::mavlink::command_long result;
  result.target_system = 1;
  result.target_component = 1;
  result.command = io::mavlink::number(what);
  result.param1 = param1;
  result.param2 = param2;
  result.param3 = param3;
  result.param7 = param7;
  return result;
}

} // namespace godwit::drill
