// Towards ground stations: which messages ground_port takes and sends. Each is one list.
//
// | Taken from a station                                        | For                                            |
// |-------------------------------------------------------------|------------------------------------------------|
// | HEARTBEAT                                                   | who is there; the operator's link              |
// | MISSION_COUNT, _ITEM_INT, _ITEM, _REQUEST, _REQUEST_INT, _REQUEST_LIST, _ACK, _CLEAR_ALL | plan transfer    |
// | MISSION_SET_CURRENT                                         | as DO_SET_MISSION_CURRENT, without an answer   |
// | COMMAND_LONG, COMMAND_INT                                   | the table in core_commands.cpp                 |
// | PARAM_REQUEST_LIST, _REQUEST_READ, _SET                     | a short list that can not be set               |
// | TIMESYNC, PING                                              | answered                                       |
//
// Nothing that a station says goes on to the vehicle. SETUP_SIGNING is not taken: keys come from files. Sent are the
// answers to these, the port's own HEARTBEAT, MISSION_CURRENT, MISSION_ITEM_REACHED and STATUSTEXT, and what of the
// vehicle's is forwarded (forward_gate.hpp). Any other message that arrives is counted and goes no further.
#pragma once

#include "io/mavlink/messages.hpp"
#include "io/mavlink/messages/mission_write_partial_list.hpp"

namespace godwit::ground_port {

namespace mavlink = io::mavlink;

using transfer_messages =
    mavlink::message_list<mavlink::mission_count, mavlink::mission_item_int, mavlink::mission_item,
                          mavlink::mission_request, mavlink::mission_request_int, mavlink::mission_request_list,
                          mavlink::mission_ack, mavlink::mission_clear_all, mavlink::mission_write_partial_list>;

using other_messages =
    mavlink::message_list<mavlink::heartbeat, mavlink::mission_set_current, mavlink::command_long, mavlink::command_int,
                          mavlink::param_request_list, mavlink::param_request_read, mavlink::param_set,
                          mavlink::timesync, mavlink::ping>;

using sent_messages =
    mavlink::message_list<mavlink::heartbeat, mavlink::mission_count, mavlink::mission_item_int, mavlink::mission_item,
                          mavlink::mission_request, mavlink::mission_request_int, mavlink::mission_ack,
                          mavlink::mission_current, mavlink::mission_item_reached, mavlink::command_ack,
                          mavlink::param_value, mavlink::timesync, mavlink::ping, mavlink::autopilot_version,
                          mavlink::protocol_version, mavlink::home_position, mavlink::statustext>;

template <class M>
concept sent = mavlink::message<M> && sent_messages::contains(M::message_id);

} // namespace godwit::ground_port
