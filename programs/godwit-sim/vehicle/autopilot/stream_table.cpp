#include "programs/godwit-sim/vehicle/autopilot/stream_table.hpp"

#include <array>

#include "io/mavlink/messages.hpp"
#include "io/mavlink/messages/heartbeat.hpp"

namespace godwit::sim {

namespace {

using namespace io::mavlink;

constexpr std::int64_t hz(std::int64_t rate) { return ns_per_s / rate; }
constexpr std::int64_t each_s(std::int64_t seconds) { return seconds * ns_per_s; }

constexpr std::array<role::streamed_message, 10> rover_table{{
    {heartbeat::message_id, hz(1)},
    {sys_status::message_id, hz(1)},
    {system_time::message_id, hz(1)},
    {gps_raw_int::message_id, hz(1)},
    {extended_sys_state::message_id, hz(1)},
    {attitude::message_id, hz(5)},
    {global_position_int::message_id, hz(5)},
    {vfr_hud::message_id, hz(2)},
    {battery_status::message_id, each_s(2)},
    {home_position::message_id, each_s(2)},
}};

constexpr std::array<role::streamed_message, 13> px4_table{{
    {heartbeat::message_id, hz(1)},
    {sys_status::message_id, hz(1)},
    {system_time::message_id, 0},
    {gps_raw_int::message_id, hz(5)},
    {extended_sys_state::message_id, hz(1)},
    {attitude::message_id, hz(50)},
    {global_position_int::message_id, hz(50)},
    {vfr_hud::message_id, hz(4)},
    {battery_status::message_id, each_s(2)},
    {home_position::message_id, each_s(2)},
    {estimator_status::message_id, each_s(2)},
    {ping::message_id, each_s(10)},
    {current_mode::message_id, each_s(2)},
}};

constexpr std::array<role::streamed_message, 12> ardupilot_table{{
    {heartbeat::message_id, hz(1)},
    {sys_status::message_id, hz(1)},
    {system_time::message_id, hz(1)},
    {gps_raw_int::message_id, hz(1)},
    {extended_sys_state::message_id, 0},
    {attitude::message_id, hz(1)},
    {global_position_int::message_id, hz(1)},
    {vfr_hud::message_id, hz(1)},
    {battery_status::message_id, hz(1)},
    {home_position::message_id, 0},
    {ekf_status_report::message_id, hz(1)},
    {timesync::message_id, each_s(10)},
}};

// Extended status 2, position 6, extra 10 to 12.
constexpr std::array<stream_group, 9> groups{{
    {2, sys_status::message_id},
    {2, gps_raw_int::message_id},
    {2, mission_current::message_id},
    {6, global_position_int::message_id},
    {10, attitude::message_id},
    {11, vfr_hud::message_id},
    {12, system_time::message_id},
    {12, battery_status::message_id},
    {12, ekf_status_report::message_id},
}};

} // namespace

stream_table rover_streams() { return rover_table; }
stream_table px4_streams() { return px4_table; }
stream_table ardupilot_streams() { return ardupilot_table; }
std::span<const stream_group> stream_groups() { return groups; }

} // namespace godwit::sim
