#include "actors/ground_port/vehicle_role/order.hpp"

#include <limits>

#include "io/mavlink/frame_meaning.hpp"

namespace godwit::ground_port::vehicle_role {

namespace {

// Of a frame that is not known as of a local one: whoever obeys looks at the frame.
double integer_scale(std::uint8_t frame) {
  return mavlink::units_of(mavlink::coordinates_of(frame).value_or(mavlink::coordinate_kind::local));
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

order read_order(mavlink::sender from, const mavlink::mission_item_int& m) {
  constexpr float default_speed = -1;
  const auto scale = integer_scale(m.frame);
  return {.from = from,
          .command = mavlink::number(mavlink::mav_cmd::do_reposition),
          .target_component = m.target_component,
          .is_in_integers = true,
          .is_item = true,
          .param1 = default_speed,
          .param4 = std::numeric_limits<float>::quiet_NaN(),
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
