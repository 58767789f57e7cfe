#include "actors/ground_port/vehicle_role/mission_start.hpp"

#include <cmath>
#include <utility>

namespace godwit::ground_port::vehicle_role {

namespace {

using io::mavlink::mav_result;

bool is_sequence(float value) { return std::isfinite(value) && value >= 0 && std::trunc(value) == value; }

start_decision refused(mav_result result, std::string text) { return {.result = result, .text = std::move(text)}; }

} // namespace

start_decision decide_start(const start_request& what, const start_situation& now) {
  if (!is_sequence(what.first_item) || !is_sequence(what.last_item))
    return refused(mav_result::denied, "Mission start: not an item number");
  if (now.item_count <= 0)
    return refused(mav_result::failed, "Mission start: no mission");
  // Compared as floats: what is beyond the mission need not fit into an integer.
  const auto count = static_cast<float>(now.item_count);
  if (what.first_item >= count)
    return refused(mav_result::failed, "Mission start: first item is beyond the mission");
  if (what.last_item >= count)
    return refused(mav_result::denied, "Mission start: last item is beyond the mission");
  const auto first = static_cast<int>(what.first_item);
  const auto last = what.last_item == 0 ? now.item_count - 1 : static_cast<int>(what.last_item);
  if (last < first)
    return refused(mav_result::denied, "Mission start: last item is before the first");
  if (now.is_transferring)
    return refused(mav_result::temporarily_rejected, "Mission start: a transfer is running");
  if (!now.not_ready.empty())
    return refused(mav_result::temporarily_rejected, "Mission start: " + now.not_ready);
  if (!now.is_armed && !now.arms_on_start)
    return refused(mav_result::denied, "Mission start: disarmed");
  return {.result = mav_result::accepted, .first = first, .last = last, .text = "Mission started"};
}

} // namespace godwit::ground_port::vehicle_role
