// What tells one simulated autopilot from another and can be said as data; what can not is a class of its own (rover,
// px4, copter, plane). Thread: constants.
//
// Source: recordings of PX4 1.17 and ArduPilot 4.7, and the MAVLink text for the rover, which is nobody's product.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "actors/ground_port/mission_server/server_profile.hpp"
#include "actors/ground_port/vehicle_role/param_table.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages/version.hpp"
#include "programs/godwit-sim/vehicle/autopilot/mode_table.hpp"
#include "programs/godwit-sim/vehicle/autopilot/stream_table.hpp"
#include "programs/godwit-sim/vehicle/flight/craft.hpp"
#include "programs/godwit-sim/vehicle/personality.hpp"

namespace godwit::sim {

// Bits of SYS_STATUS.
struct sensor_bits {
  std::uint32_t present = 0;
  std::uint32_t enabled = 0;
  std::uint32_t health = 0; // when all is well
};
inline constexpr std::uint32_t gps_bit = 0x20;           // MAV_SYS_STATUS_SENSOR_GPS
inline constexpr std::uint32_t prearm_bit = 0x1000'0000; // MAV_SYS_STATUS_PREARM_CHECK

// Whom the answer to a TIMESYNC names.
enum class timesync_target { nobody, asker, system_of_asker };

struct traits {
  mavlink::mav_type type{};
  mavlink::mav_autopilot autopilot{};
  craft body;
  mode_table modes;
  std::uint32_t first_mode = 0; // after a start

  plans::server_profile plan_profile;
  std::vector<role::param> params;
  role::param_encoding param_encoding{};
  bool has_param_file = false;    // for MAVLink FTP
  bool hides_param_index = false; // 65535 in answer to a read by name and to a set

  stream_table streams;
  bool knows_stream_groups = false;
  bool tells_current_on_change = true;    // MISSION_CURRENT
  bool current_is_a_request_away = true;  // MISSION_CURRENT: REQUEST_MESSAGE and SET_MESSAGE_INTERVAL work for it
  bool sends_before_ack = false;          // the message that was asked for
  mavlink::mav_result unknown_message{};  // REQUEST_MESSAGE
  mavlink::mav_result unknown_interval{}; // SET_MESSAGE_INTERVAL

  bool acknowledges_where_heard = false; // COMMAND_ACK, on each line where who asked was heard; else where it asked
  bool acknowledges_set_mode = false;    // the message, as if it were DO_SET_MODE
  bool flies_to_items = false;           // with current = 2, which are no part of a plan
  std::vector<std::string_view> texts_for_uploader; // of transfers, on the line of who transfers alone

  bool answers_ping = true;
  sim::timesync_target timesync_target{};
  std::vector<std::string_view> banner; // said to a station that asks for all parameters
  bool numbers_each_text = false;
  bool hears_any_component = false;  // orders and parameters: of its system; else its own and 0
  bool tells_stale_position = false; // goes on with GLOBAL_POSITION_INT when there is no position

  bool tells_intended_mode = false;  // CURRENT_MODE
  bool beats_at_mode_change = false; // a HEARTBEAT at once, besides those of each second
  bool sets_home_when_armed = false; // on the ground, until a command has fixed it
  bool home_is_free_again = false;   // by DO_SET_HOME with the place where it is; else until the next start

  sensor_bits sensors;
  std::uint8_t fix_type = 3;                 // gps_fix_type when all is well
  std::int64_t boots_ns = 0;                 // after a restart: says so in its heartbeats, and nothing else; world time
  std::int64_t ready_after_ns = 0;           // of a start, world time: until then it can not be armed for a flight
  std::int64_t estimate_after_ns = 0;        // the same: until then its estimator does not know where it is
  std::uint16_t total_of_no_mission = 65535; // MISSION_CURRENT
  mavlink::autopilot_version version;
  bool tells_protocol_version = true;
};

[[nodiscard]] const traits& traits_of(personality who);

} // namespace godwit::sim
