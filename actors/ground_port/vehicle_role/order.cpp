#include "actors/ground_port/vehicle_role/order.hpp"

namespace godwit::ground_port::vehicle_role {

namespace {

// What the integers of COMMAND_INT count: 1e-7 degrees in the global frames, 1e-4 m in the local ones, and a plain
// number where there is no position.
double integer_scale(std::uint8_t frame) {
  switch (frame) {
  case 0:  // global
  case 3:  // global_relative_alt
  case 5:  // global_int
  case 6:  // global_relative_alt_int
  case 10: // global_terrain_alt
  case 11: // global_terrain_alt_int
    return 1e7;
  case 2: // mission
    return 1;
  default:
    return 1e4;
  }
}

} // namespace

order read_order(mavlink::sender from, const mavlink::command_long& m) {
  return {.from = from,
          .command = m.command,
          .target_component = m.target_component,
          .is_in_integers = false,
          .confirmation = m.confirmation,
          .param1 = m.param1,
          .param2 = m.param2,
          .param3 = m.param3,
          .param4 = m.param4,
          .x = m.param5,
          .y = m.param6,
          .z = m.param7,
          .frame = mavlink::number(mavlink::mav_frame::global_relative_alt)};
}

order read_order(mavlink::sender from, const mavlink::command_int& m) {
  const auto scale = integer_scale(m.frame);
  return {.from = from,
          .command = m.command,
          .target_component = m.target_component,
          .is_in_integers = true,
          .param1 = m.param1,
          .param2 = m.param2,
          .param3 = m.param3,
          .param4 = m.param4,
          .x = m.x / scale,
          .y = m.y / scale,
          .z = m.z,
          .frame = m.frame};
}

mavlink::command_ack answer_to(const order& what, mavlink::mav_result result, std::uint8_t progress,
                               std::int32_t result_param2) {
  return {.command = what.command,
          .result = mavlink::number(result),
          .progress = progress,
          .result_param2 = result_param2,
          .target_system = what.from.system,
          .target_component = what.from.component};
}

} // namespace godwit::ground_port::vehicle_role
