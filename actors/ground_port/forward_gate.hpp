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

} // namespace godwit::ground_port
