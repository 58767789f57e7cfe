#include "actors/ground_port/mission_server/server_profile.hpp"

namespace godwit::ground_port::mission_server {

namespace {

using mavlink::mav_mission_result;

// TURN_NS: of the main loop, which takes one message of a transfer each time round.
server_profile ardupilot(std::int64_t turn_ns) {
  server_profile result;
  result.asks_with = request_kind::mission_request;
  result.asks_in_both_ways = false;
  result.asks_again_ns = 1'000 * ns_per_ms;
  result.gives_up_ns = 8'000 * ns_per_ms;
  result.when_giving_up = giving_up::tells;
  result.when_out_of_order = out_of_order::acknowledged_as_error;
  result.when_last_item_comes_again = last_item_again::error;
  result.when_item_is_foreign = foreign_item::by_order;
  result.when_busy = mav_mission_result::denied;
  result.when_list_is_refused = mav_mission_result::denied;
  result.when_clear_is_refused = mav_mission_result::error;
  result.obeys_cancel = false;
  result.refused_count_ends_upload = false;
  result.when_read = while_read::nobody_waits;
  result.serves_any_item = true;
  result.tells_count_to_the_lost = true;
  result.takes_float_items = true;
  result.when_partial = partial_list::taken;
  result.accepts = accepted_address::everything;
  result.turn_ns = turn_ns;
  result.is_atomic = false;
  result.has_plan_ids = false;
  result.rewrites_items = true;
  result.home = mavlink::mission_item_int{};
  result.home->command = mavlink::number(mavlink::mav_cmd::nav_waypoint);
  result.home->autocontinue = 1;
  result.clears_all_types_at_once = false;
  result.when_cleared_in_flight = mav_mission_result::error;
  result.when_counted_0_in_flight = std::nullopt;
  result.fence = {mav_mission_result::error, false, true};
  result.capacity = 655;
  result.texts = ardupilot_texts();
  return result;
}

} // namespace

server_profile plain_profile() { return {}; }

server_profile px4_profile() {
  server_profile result;
  result.asks_in_both_ways = false;
  result.asks_again_ns = 260 * ns_per_ms;
  result.serves_earlier_items = false;
  result.when_out_of_order = out_of_order::ignored;
  result.when_item_is_foreign = foreign_item::ignored;
  result.when_count_comes_again = count_again::asks_again_before_item_1;
  result.when_busy = mav_mission_result::error;
  result.when_list_is_refused = std::nullopt;
  result.when_clear_is_refused = mav_mission_result::error;
  result.refused_count_ends_upload = false;
  result.when_read = while_read::everybody_waits;
  result.list_ends_a_full_download = true;
  result.takes_float_items = true;
  result.when_partial = partial_list::ignored;
  result.accepts = accepted_address::component_0_too;
  result.marks_current = true;
  result.checks_type = false;
  result.checks_latitude = false;
  result.when_cleared_in_flight = std::nullopt;
  result.when_counted_0_in_flight = std::nullopt;
  result.fence = {mav_mission_result::error, true, false};
  result.capacity = 2'000;
  result.texts = px4_texts();
  return result;
}

server_profile ardupilot_copter_profile() { return ardupilot(2'500'000); }
server_profile ardupilot_plane_profile() { return ardupilot(20 * ns_per_ms); }
server_profile ardupilot_rover_profile() { return ardupilot(20 * ns_per_ms); }

} // namespace godwit::ground_port::mission_server
