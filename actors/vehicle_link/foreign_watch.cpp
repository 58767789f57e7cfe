#include "actors/vehicle_link/foreign_watch.hpp"

#include <algorithm>
#include <array>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"

namespace godwit::vehicle_link {

namespace {

namespace mavlink = io::mavlink;
using mavlink::mav_cmd;
using mavlink::number;

constexpr std::uint16_t item_to_fly_to = UINT16_MAX; // no command
constexpr auto set_mode_message = static_cast<std::uint16_t>(mavlink::set_mode::message_id);

// Commands by which somebody has the vehicle. ArduPilot acknowledges SET_MODE as a command with its message id.
constexpr std::array takes_vehicle{number(mav_cmd::component_arm_disarm),
                                   number(mav_cmd::do_set_mode),
                                   number(mav_cmd::mission_start),
                                   number(mav_cmd::nav_takeoff),
                                   number(mav_cmd::nav_land),
                                   number(mav_cmd::nav_return_to_launch),
                                   number(mav_cmd::do_reposition),
                                   number(mav_cmd::do_pause_continue),
                                   number(mav_cmd::do_set_mission_current),
                                   set_mode_message};

// The command that is in a forwarded frame; SET_MODE is one.
std::optional<std::uint16_t> command_of(const relayed_frame& what) {
  constexpr std::size_t command_at = 28; // on the wire, in COMMAND_LONG and COMMAND_INT alike
  if (what.message == mavlink::set_mode::message_id)
    return set_mode_message;
  if (what.message != mavlink::command_long::message_id && what.message != mavlink::command_int::message_id)
    return std::nullopt;
  const auto at = [&](std::size_t i) { return i < what.payload.size() ? what.payload[i] : std::uint8_t{0}; };
  return static_cast<std::uint16_t>(at(command_at) | (at(command_at + 1) << 8U));
}

template <class M>
bool changes_plan_of(std::uint8_t vehicle, const mavlink::frame_view& frame) {
  if (frame.id() != M::message_id)
    return false;
  const auto m = mavlink::decode<M>(frame);
  if constexpr (requires { m.mission_type; })
    if (m.mission_type != number(mavlink::mav_mission_type::mission) &&
        m.mission_type != number(mavlink::mav_mission_type::all))
      return false;
  return m.target_system == vehicle;
}

} // namespace

void foreign_watch::on_forwarded(const relayed_frame& what, std::int64_t now_ns) {
  const bool is_item =
      what.message == mavlink::mission_item::message_id || what.message == mavlink::mission_item_int::message_id;
  const auto command = is_item ? std::optional(item_to_fly_to) : command_of(what);
  if (!command)
    return;
  if (forwarded_.size() == max_forwarded)
    forwarded_.pop_front();
  forwarded_.push_back({what.system, what.component, *command, now_ns});
}

std::optional<foreign_act> foreign_watch::on_ack(const mavlink::command_ack& m, bool is_ours, std::int64_t now_ns) {
  using mavlink::mav_result;
  const bool does_it = m.result == number(mav_result::accepted) || m.result == number(mav_result::in_progress);
  const bool takes = std::ranges::find(takes_vehicle, m.command) != takes_vehicle.end();
  if (is_ours || !does_it || !takes || is_forwarded(m, now_ns))
    return std::nullopt;
  return act(foreign_kind::command, m.command, {m.target_system, m.target_component}, now_ns);
}

// An ArduPilot answers an item that it flies to at once like one of an upload.
std::optional<foreign_act> foreign_watch::on_plan_answer(std::uint8_t system, std::uint8_t component,
                                                         std::int64_t now_ns) {
  if (is_forwarded({.command = item_to_fly_to, .target_system = system, .target_component = component}, now_ns))
    return std::nullopt;
  return act(foreign_kind::plan, 0, {system, component}, now_ns);
}

std::optional<foreign_act> foreign_watch::on_frame(const mavlink::frame_view& frame, std::uint8_t vehicle,
                                                   std::int64_t now_ns) {
  if (!changes_plan_of<mavlink::mission_count>(vehicle, frame) &&
      !changes_plan_of<mavlink::mission_clear_all>(vehicle, frame) &&
      !changes_plan_of<mavlink::mission_write_partial_list>(vehicle, frame) &&
      !changes_plan_of<mavlink::mission_set_current>(vehicle, frame))
    return std::nullopt;
  return act(foreign_kind::plan, 0, frame.from(), now_ns);
}

// PX4 acknowledges SET_MODE as DO_SET_MODE.
bool foreign_watch::is_forwarded(const mavlink::command_ack& m, std::int64_t now_ns) const {
  return std::ranges::any_of(forwarded_, [&](const forwarded& each) {
    const bool is_same =
        each.command == m.command || (each.command == set_mode_message && m.command == number(mav_cmd::do_set_mode));
    const bool is_to_sender =
        m.target_system == 0 ||
        (m.target_system == each.system && (m.target_component == 0 || m.target_component == each.component));
    return is_same && is_to_sender && now_ns - each.at_ns <= forwarded_counts_ns;
  });
}

foreign_act foreign_watch::act(foreign_kind kind, std::uint16_t command, mavlink::sender who, std::int64_t now_ns) {
  last_ns_ = std::max(now_ns, last_ns_ + 1);
  return {kind, command, who.system, who.component, last_ns_};
}

} // namespace godwit::vehicle_link
