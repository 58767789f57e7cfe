// Compiles only when the table of each message gives the published CRC_EXTRA and lengths (message definitions
// common.xml, ardupilotmega.xml). It stands here once, and not in the headers, because every source file would compute
// it again.
#include "io/mavlink/messages/camera.hpp"
#include "io/mavlink/messages/clock.hpp"
#include "io/mavlink/messages/command.hpp"
#include "io/mavlink/messages/gimbal.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "io/mavlink/messages/mission.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"
#include "io/mavlink/messages/param.hpp"
#include "io/mavlink/messages/position.hpp"
#include "io/mavlink/messages/request_data_stream.hpp"
#include "io/mavlink/messages/setup_signing.hpp"
#include "io/mavlink/messages/traffic.hpp"
#include "io/mavlink/messages/vehicle_status.hpp"
#include "io/mavlink/messages/version.hpp"

namespace godwit::io::mavlink {

static_assert(as_published<adsb_vehicle>(38, 38));
static_assert(as_published<battery_status>(36, 54));
static_assert(as_published<system_time>(12, 12));
static_assert(as_published<ping>(14, 14));
static_assert(as_published<timesync>(16, 18));
static_assert(as_published<set_mode>(6, 6));
static_assert(as_published<camera_feedback>(45, 47));
static_assert(as_published<camera_image_captured>(255, 255));
static_assert(as_published<collision>(19, 19));
static_assert(as_published<command_int>(35, 35));
static_assert(as_published<command_long>(33, 33));
static_assert(as_published<command_ack>(3, 10));
static_assert(as_published<command_cancel>(4, 4));
static_assert(as_published<current_mode>(9, 9));
static_assert(as_published<ekf_status_report>(22, 26));
static_assert(as_published<estimator_status>(42, 42));
static_assert(as_published<fence_status>(8, 9));
static_assert(as_published<gimbal_device_attitude_status>(40, 49));
static_assert(as_published<heartbeat>(9, 9));
static_assert(as_published<sys_status>(31, 43));
static_assert(as_published<extended_sys_state>(2, 2));
static_assert(as_published<statustext>(51, 54));
static_assert(as_published<mission_set_current>(4, 4));
static_assert(as_published<mission_current>(2, 18));
static_assert(as_published<mission_item_reached>(2, 2));
static_assert(as_published<mission_item>(37, 38));
static_assert(as_published<mission_request>(4, 5));
static_assert(as_published<mission_request_list>(2, 3));
static_assert(as_published<mission_count>(4, 9));
static_assert(as_published<mission_clear_all>(2, 3));
static_assert(as_published<mission_ack>(3, 8));
static_assert(as_published<mission_request_int>(4, 5));
static_assert(as_published<mission_item_int>(37, 38));
static_assert(as_published<mission_write_partial_list>(6, 7));
static_assert(as_published<param_request_read>(20, 20));
static_assert(as_published<param_request_list>(2, 2));
static_assert(as_published<param_value>(25, 25));
static_assert(as_published<param_set>(23, 23));
static_assert(as_published<gps_raw_int>(30, 52));
static_assert(as_published<attitude>(28, 28));
static_assert(as_published<global_position_int>(28, 28));
static_assert(as_published<vfr_hud>(20, 20));
static_assert(as_published<home_position>(52, 60));
static_assert(as_published<radio_status>(9, 9));
static_assert(as_published<request_data_stream>(6, 6));
static_assert(as_published<setup_signing>(42, 42));
static_assert(as_published<autopilot_version>(60, 78));
static_assert(as_published<protocol_version>(22, 22));

} // namespace godwit::io::mavlink
