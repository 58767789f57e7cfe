// The part of the core that is about mission items which are no part of a plan: an ArduPilot flies to them at once.
//
//   MISSION_ITEM, _INT with current = 2   as DO_REPOSITION, answered by MISSION_ACK
//   with current = 3                      the altitude alone: a person's command
//
// Older stations say "go to" so, QGroundControl its first one. Where a person has the vehicle the item goes on, and the
// vehicle's MISSION_ACK comes back to its station.
#include <utility>

#include "actors/ground_port/core.hpp"
#include "actors/ground_port/decision_context.hpp"
#include "actors/ground_port/mission_server/item_forms.hpp"
#include "actors/ground_port/passing/as_said.hpp"

namespace godwit::ground_port {

namespace {

using executor::act_kind;
using mavlink::mav_mission_result;
using mavlink::mav_result;

constexpr auto item_message = static_cast<std::uint16_t>(mavlink::mission_item::message_id);

} // namespace

// True: it is dealt with.
bool core::route_item(decision_context& t, const mavlink::frame_view& frame) {
  if (owner_.autopilot != mavlink::mav_autopilot::ardupilotmega)
    return false;
  mavlink::mission_item_int item;
  if (frame.id() == mavlink::mission_item_int::message_id)
    item = mavlink::decode<mavlink::mission_item_int>(frame);
  else if (frame.id() == mavlink::mission_item::message_id)
    item = mission_server::in_integers(mavlink::decode<mavlink::mission_item>(frame));
  const bool is_at_once =
      item.current == vehicle_role::item_to_fly_to || item.current == vehicle_role::item_with_altitude;
  if (!is_at_once || item.mission_type != mavlink::number(mavlink::mav_mission_type::mission))
    return false;
  const bool is_go_to =
      item.current == vehicle_role::item_to_fly_to && item.command == mavlink::number(mavlink::mav_cmd::nav_waypoint);
  const auto what = vehicle_role::read_order(frame.from(), item);
  ask(t, {{is_go_to ? act_kind::go_to : act_kind::command, by(frame.from()), is_go_to ? "Go to" : "Altitude"},
          passing::as_said(frame),
          what});
  return true;
}

void core::answer_item(decision_context& t, const vehicle_role::order& what, mav_result result) {
  if (result == mav_result::in_progress)
    return;
  const auto how = result == mav_result::accepted ? mav_mission_result::accepted : mav_mission_result::error;
  t.send_as(stations_.way_to(what.from),
            mavlink::mission_ack{.target_system = what.from.system,
                                 .target_component = what.from.component,
                                 .type = mavlink::number(how)},
            asked_one(what.target_component));
}

void core::note_forwarded_item(mavlink::sender by, std::int64_t now_ns) {
  forwarded_items_.put(by, {item_message, item_message}, 0, now_ns);
}

// Of the vehicle's MISSION_ACKs those alone that answer an item which went on: godwit's own transfers are no station's.
bool core::is_answer_to_item(const vehicle_link::relayed_frame& m, std::int64_t now_ns) {
  const auto ack = mavlink::decode_payload<mavlink::mission_ack>(std::as_bytes(std::span(m.payload)));
  return !forwarded_items_.acknowledge({ack.target_system, ack.target_component}, item_message, now_ns).empty();
}

} // namespace godwit::ground_port
