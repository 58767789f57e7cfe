#include "actors/vehicle_link/transfer/outcome.hpp"

namespace godwit::vehicle_link::transfer {

std::string sentence_for_mission_result(std::uint8_t result) {
  using io::mavlink::mav_mission_result;
  switch (static_cast<mav_mission_result>(result)) {
  case mav_mission_result::accepted:
    return "the vehicle accepted it";
  case mav_mission_result::error:
    return "the vehicle gave an error without a reason; it may be busy with another transfer";
  case mav_mission_result::unsupported_frame:
    return "the vehicle does not know the coordinate frame of an item";
  case mav_mission_result::unsupported:
    return "the vehicle does not know a command in it, or does not keep plans of this type";
  case mav_mission_result::no_space:
    return "the vehicle has no room for so many items";
  case mav_mission_result::invalid:
    return "the vehicle found an item invalid";
  case mav_mission_result::invalid_param1:
  case mav_mission_result::invalid_param2:
  case mav_mission_result::invalid_param3:
  case mav_mission_result::invalid_param4:
    return "the vehicle found parameter " +
           std::to_string(result + 1 - static_cast<int>(mav_mission_result::invalid_param1)) + " of an item invalid";
  case mav_mission_result::invalid_param5_x:
    return "the vehicle found x (the latitude) of an item invalid";
  case mav_mission_result::invalid_param6_y:
    return "the vehicle found y (the longitude) of an item invalid";
  case mav_mission_result::invalid_param7:
    return "the vehicle found z (the altitude) of an item invalid";
  case mav_mission_result::invalid_sequence:
    return "the vehicle expected another item";
  case mav_mission_result::denied:
    return "the vehicle denied it: another station transfers a plan, or its state does not allow it";
  case mav_mission_result::operation_cancelled:
    return "the vehicle gave the transfer up";
  }
  return "the vehicle answered with result " + std::to_string(result) + ", which is not known here";
}

} // namespace godwit::vehicle_link::transfer
