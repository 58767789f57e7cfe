// What came in and waits for its turn: an autopilot takes one message of a transfer in each turn of its main loop.
//
// A turn comes each turn_ns, counted from time 0, whether or not anything waits. With turn_ns 0 nothing waits longer
// than the call. When it is full the newest is dropped, as a receive buffer does. Thread: one at a time.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"

namespace godwit::ground_port::mission_server {

using incoming =
    std::variant<io::mavlink::mission_count, io::mavlink::mission_item_int, io::mavlink::mission_item,
                 io::mavlink::mission_request, io::mavlink::mission_request_int, io::mavlink::mission_request_list,
                 io::mavlink::mission_ack, io::mavlink::mission_clear_all, io::mavlink::mission_write_partial_list>;

struct letter {
  io::mavlink::sender from;
  incoming what;
};

// 5 kB of items. All of them take an ArduPilot Rover 1.9 s, so that with its patience of 8 s it is idle after 10 s.
inline constexpr std::size_t max_waiting_messages = 96;

class inbox {
public:
  explicit inbox(std::int64_t turn_ns) : turn_ns_(turn_ns) {}

  void put(const letter& each, std::int64_t now_ns);
  // The oldest, if its turn has come at NOW. It takes the turn.
  [[nodiscard]] std::optional<letter> take(std::int64_t now_ns);

  [[nodiscard]] std::int64_t next_turn_ns() const {
    return waiting_.empty() ? std::numeric_limits<std::int64_t>::max() : turn_at_ns_;
  }
  [[nodiscard]] bool is_empty() const { return waiting_.empty(); }
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

private:
  [[nodiscard]] std::int64_t turn_after(std::int64_t now_ns) const;

  std::int64_t turn_ns_;
  std::int64_t turn_at_ns_ = 0; // of the oldest
  std::deque<letter> waiting_;
  std::uint64_t dropped_ = 0;
};

// What an event leads to on the vehicle's side: messages to stations, changes of what is held, sentences for people.
//
// A `replaced` and a `cleared` say what is held from now on. An atomic vehicle is told of nothing before that; on one
// that is not, `begun_replacing` comes with MISSION_COUNT: the plan that was there is cut, and must not be flown on.
// Thread: values. Source: MAVLink mission protocol.

namespace mavlink = io::mavlink;

using outgoing = std::variant<mavlink::mission_request, mavlink::mission_request_int, mavlink::mission_ack,
                              mavlink::mission_count, mavlink::mission_item_int, mavlink::mission_item>;

enum class plan_change_kind { begun_replacing, replaced, cleared };

struct plan_change {
  plan_change_kind kind = plan_change_kind::replaced;
  mavlink::mav_mission_type type{};
  std::uint32_t plan_id = 0; // 0: none, or a vehicle without ids
  int count = 0;             // items that are held; begun_replacing: that are still held
  mavlink::sender by;
  std::optional<int> marked_current; // replaced: the last item of a mission that came with `current` 1
  bool identical = false;            // replaced: by items that say the same. PX4 does not start on such a plan
};

// For STATUSTEXT, to everybody.
struct status_text {
  std::uint8_t severity = 0; // mav_severity
  std::string text;
};

struct reaction {
  std::vector<outgoing> messages; // each has its target
  std::vector<plan_change> changes;
  std::vector<status_text> texts;
};

} // namespace godwit::ground_port::mission_server
