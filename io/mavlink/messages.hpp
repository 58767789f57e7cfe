// All messages that godwit reads and writes. A new one is a struct with its table in messages/ and its name here.
//
// The list is short on purpose: each entry is something that a peer can say to us. Of all other messages only the
// checksum is verified (io/mavlink/ids.hpp). Thread: pure.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "io/mavlink/codec.hpp"
#include "io/mavlink/messages/camera.hpp"
#include "io/mavlink/messages/clock.hpp"
#include "io/mavlink/messages/command.hpp"
#include "io/mavlink/messages/gimbal.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "io/mavlink/messages/mission.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"
#include "io/mavlink/messages/param.hpp"
#include "io/mavlink/messages/position.hpp"
#include "io/mavlink/messages/setup_signing.hpp"
#include "io/mavlink/messages/traffic.hpp"
#include "io/mavlink/messages/vehicle_status.hpp"
#include "io/mavlink/messages/version.hpp"

namespace godwit::io::mavlink {

// A list of message types, and the way from the id of a frame to the type.
//
// `visit<List>(frame, f)` decodes the frame and calls f(const M&) if its id is in the list, through one table lookup
// and one jump. Thread: pure.
template <message... Ms>
struct message_list {
  static constexpr std::size_t size = sizeof...(Ms);
  static constexpr std::uint32_t max_id = std::max({Ms::message_id...});

  static constexpr std::uint8_t none = 0xFF;
  static_assert(size < none);

  // Place in the list by id; `none` for ids that are not in it.
  static constexpr auto places = [] {
    std::array<std::uint8_t, max_id + 1> result{};
    result.fill(none);
    std::uint8_t place = 0;
    ((result[Ms::message_id] = place++), ...);
    return result;
  }();

  [[nodiscard]] static constexpr std::uint8_t place_of(std::uint32_t id) { return id <= max_id ? places[id] : none; }
  [[nodiscard]] static constexpr bool contains(std::uint32_t id) { return place_of(id) != none; }

  // Calls F.template operator()<M>() for each type of the list, in its order.
  template <class F>
  static constexpr void for_each(F&& f) {
    (f.template operator()<Ms>(), ...);
  }

  // False, and F is not called, if the id of FRAME is not in the list.
  template <class F>
  static bool visit(const frame_view& frame, F&& f) {
    using handler = void (*)(const frame_view&, F&);
    static constexpr std::array<handler, size> handlers{
        +[](const frame_view& each, F& callback) { callback(decode<Ms>(each)); }...};
    const auto place = place_of(frame.id());
    if (place == none)
      return false;
    handlers[place](frame, f);
    return true;
  }
};

using known_messages =
    message_list<heartbeat, sys_status, system_time, ping, set_mode, param_request_read, param_request_list,
                 param_value, param_set, gps_raw_int, attitude, global_position_int, mission_item, mission_request,
                 mission_set_current, mission_current, mission_request_list, mission_count, mission_clear_all,
                 mission_item_reached, mission_ack, mission_request_int, mission_item_int, vfr_hud, command_int,
                 command_long, command_ack, command_cancel, radio_status, timesync, battery_status, autopilot_version,
                 fence_status, ekf_status_report, estimator_status, home_position, extended_sys_state, statustext,
                 setup_signing, gimbal_device_attitude_status, protocol_version, camera_feedback, camera_image_captured,
                 adsb_vehicle, collision>;

// Decodes FRAME and calls F(const M&) with the message; false if it is not one of ours.
template <class F>
bool visit(const frame_view& frame, F&& f) {
  return known_messages::visit(frame, f);
}

} // namespace godwit::io::mavlink
