// Which of the vehicle's messages go on to the ground stations, and how often.
//
// Each message has a least interval; what comes sooner is held back and counted, so that a slow line to the ground is
// not flooded by a fast one to the autopilot. On average a faster stream goes on at just that interval: of five in a
// second four go on at 250 ms, and not every second one. A station changes an interval with SET_MESSAGE_INTERVAL, for
// all who listen on this port: it is one line. The newest of each is remembered, for REQUEST_MESSAGE. HEARTBEAT always
// passes: stations tell by it that the vehicle is there. Pure. Thread: one at a time.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "io/mavlink/messages.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"

namespace godwit::ground_port {

namespace mavlink = io::mavlink;

// No COMMAND_ACK and nothing of a transfer: what the vehicle says to godwit is not for the stations.
using forwarded_messages =
    mavlink::message_list<mavlink::heartbeat, mavlink::sys_status, mavlink::system_time, mavlink::gps_raw_int,
                          mavlink::attitude, mavlink::global_position_int, mavlink::mission_current,
                          mavlink::mission_item_reached, mavlink::vfr_hud, mavlink::battery_status,
                          mavlink::autopilot_version, mavlink::fence_status, mavlink::home_position,
                          mavlink::extended_sys_state, mavlink::statustext>;

template <class List>
struct telemetry_of;
template <class... Ms>
struct telemetry_of<mavlink::message_list<Ms...>> {
  using type = std::variant<Ms...>;
};

// Any one of them.
using telemetry = telemetry_of<forwarded_messages>::type;

struct forward_rate {
  std::uint32_t message = 0;
  std::int64_t least_interval_ms = 0; // 0: as they come, -1: not at all
};

class forward_gate {
public:
  explicit forward_gate(const std::vector<forward_rate>& rates);

  // Remembers it. True: it goes on.
  [[nodiscard]] bool take(const telemetry& m, std::int64_t now_ns);
  [[nodiscard]] const std::optional<telemetry>& newest(std::uint32_t id) const; // of a forwarded message

  // As in SET_MESSAGE_INTERVAL: microseconds, -1 stops it, 0 is the default. False: it is not forwarded, it is
  // HEARTBEAT, or the interval is not one.
  [[nodiscard]] bool set_interval(std::uint32_t id, std::int64_t interval_us);

  [[nodiscard]] std::uint64_t held_back() const { return held_back_; }

private:
  struct message_lane {
    std::int64_t default_interval_ns = 0;
    std::int64_t interval_ns = 0;       // below 0: stopped
    std::optional<std::int64_t> due_ns; // of the next one; none: nothing went on yet
    std::optional<telemetry> newest;
  };
  std::array<message_lane, forwarded_messages::size> lanes_;
  std::uint64_t held_back_ = 0;
};

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
