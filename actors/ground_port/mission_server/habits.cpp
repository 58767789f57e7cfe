#include "actors/ground_port/mission_server/habits.hpp"

namespace godwit::ground_port::mission_server {

namespace {

using mavlink::mav_mission_result;

// TURN_NS: of the main loop, which takes one message of a transfer each time round.
habits ardupilot(std::int64_t turn_ns) {
  habits result;
  result.asks_with = request_kind::mission_request;
  result.asks_again_ns = 1'000 * ns_per_ms;
  result.gives_up_ns = 8'000 * ns_per_ms;
  result.when_giving_up = giving_up::tells;
  result.when_out_of_order = out_of_order::acknowledged_as_error;
  result.when_last_item_comes_again = last_item_again::error;
  result.when_busy = mav_mission_result::denied;
  result.obeys_cancel = false;
  result.serves_any_item = true;
  result.takes_float_items = true;
  result.listens_to_everybody = true;
  result.turn_ns = turn_ns;
  result.is_atomic = false;
  result.has_plan_ids = false;
  result.rewrites_items = true;
  result.home = mavlink::mission_item_int{};
  result.home->command = mavlink::number(mavlink::mav_cmd::nav_waypoint);
  result.home->autocontinue = 1;
  result.clears_all_types_at_once = false;
  result.capacity = 655;
  return result;
}

} // namespace

habits plain_habits() { return {}; }

habits px4_habits() {
  habits result;
  result.asks_again_ns = 260 * ns_per_ms;
  result.when_out_of_order = out_of_order::ignored;
  result.when_count_comes_again = count_again::begins_again_before_item_1;
  result.when_busy = mav_mission_result::error;
  result.is_busy_while_read = true;
  result.takes_float_items = true;
  result.marks_first_as_current = true;
  result.checks_type = false;
  result.checks_latitude = false;
  result.capacity = 2'000;
  return result;
}

habits ardupilot_copter_habits() { return ardupilot(2'500'000); }
habits ardupilot_plane_habits() { return ardupilot(20 * ns_per_ms); }
habits ardupilot_rover_habits() { return ardupilot(20 * ns_per_ms); }

} // namespace godwit::ground_port::mission_server
