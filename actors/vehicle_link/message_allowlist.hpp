// The surface towards the vehicle: which messages vehicle_link takes, hands on and sends. Each is one list.
//
// The lists are short on purpose: what is not on them can not be misread, not be misused, and has no tests to need.
// Any other message that arrives is counted (`not_accepted`) and goes no further. A message enters a list by a review
// of who needs it.
//
// | Taken from the autopilot | For                                                                    |
// |--------------------------|------------------------------------------------------------------------|
// | HEARTBEAT                | watchdog, mode, armed; told to listeners                               |
// | CURRENT_MODE             | mode; told to listeners                                                |
// | COMMAND_ACK              | the answer to whoever sent the command; to somebody else: foreign_watch |
// | MISSION_COUNT, _ITEM_INT, _REQUEST, _REQUEST_INT, _ACK | mission transfer                         |
// | MISSION_CURRENT          | mission transfer and set-current; told to listeners                    |
// | TIMESYNC, PING           | answered; PX4 keeps its clock offset with them                         |
// | CAMERA_FEEDBACK, CAMERA_IMAGE_CAPTURED | told to listeners as picture_taken                       |
// | the rest of `told`       | told to listeners as they are                                          |
//
// MISSION_COUNT, MISSION_CLEAR_ALL, MISSION_WRITE_PARTIAL_LIST and MISSION_SET_CURRENT of anybody else to the vehicle
// are signs of another plan (foreign_watch), and go no further. RADIO_STATUS is taken from any sender of the link: it
// is the radio's word and not the autopilot's. Of GIMBAL_DEVICE_ATTITUDE_STATUS any component of the vehicle's system
// is heard, as of CAMERA_IMAGE_CAPTURED and ADSB_VEHICLE: a gimbal, a camera or a receiver may report for itself.
//
// | Sent                                                        | When                                  |
// |-------------------------------------------------------------|---------------------------------------|
// | HEARTBEAT                                                   | once a second, while who decides here lives     |
// | COMMAND_LONG, COMMAND_INT, COMMAND_CANCEL, SET_MODE         | asked for                             |
// | COMMAND_LONG REQUEST_MESSAGE for HEARTBEAT                  | nobody was heard yet; a look          |
// | MISSION_COUNT, _ITEM_INT, _ACK, _REQUEST_LIST, _REQUEST_INT, _CLEAR_ALL | a transfer is asked for   |
// | MISSION_SET_CURRENT                                         | the vehicle has no DO_SET_MISSION_CURRENT |
// | REQUEST_DATA_STREAM                                         | SET_MESSAGE_INTERVAL brought nothing   |
// | TIMESYNC, PING                                              | answers                               |
// | SETUP_SIGNING                                               | asked for, and the link is secure     |
#pragma once

#include <concepts>
#include <variant>

#include "io/mavlink/messages.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "io/mavlink/messages/request_data_stream.hpp"

namespace godwit::vehicle_link {

namespace mavlink = io::mavlink;

// Told to listeners, as they come from the autopilot.
using told_messages =
    mavlink::message_list<mavlink::heartbeat, mavlink::current_mode, mavlink::sys_status, mavlink::system_time,
                          mavlink::gps_raw_int, mavlink::attitude, mavlink::global_position_int,
                          mavlink::mission_current, mavlink::mission_item_reached, mavlink::vfr_hud,
                          mavlink::battery_status, mavlink::autopilot_version, mavlink::fence_status,
                          mavlink::ekf_status_report, mavlink::estimator_status, mavlink::home_position,
                          mavlink::extended_sys_state, mavlink::statustext, mavlink::gimbal_device_attitude_status,
                          mavlink::radio_status, mavlink::adsb_vehicle, mavlink::collision>;

// Taken and used here.
using used_messages =
    mavlink::message_list<mavlink::command_ack, mavlink::mission_count, mavlink::mission_item_int,
                          mavlink::mission_request, mavlink::mission_request_int, mavlink::mission_ack,
                          mavlink::timesync, mavlink::ping, mavlink::camera_feedback, mavlink::camera_image_captured>;

using sent_messages =
    mavlink::message_list<mavlink::heartbeat, mavlink::command_long, mavlink::command_int, mavlink::set_mode,
                          mavlink::mission_count, mavlink::mission_item_int, mavlink::mission_ack,
                          mavlink::mission_request_list, mavlink::mission_request_int, mavlink::mission_clear_all,
                          mavlink::mission_set_current, mavlink::request_data_stream, mavlink::timesync, mavlink::ping,
                          mavlink::setup_signing>;

template <class M>
concept sent = mavlink::message<M> && sent_messages::contains(M::message_id);

template <class List>
struct variant_of;
template <class... Ms>
struct variant_of<mavlink::message_list<Ms...>> {
  using type = std::variant<Ms...>;
};

// Any one message that is told to listeners.
using observation = variant_of<told_messages>::type;

} // namespace godwit::vehicle_link
