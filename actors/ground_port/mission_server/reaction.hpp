// What an event leads to on the vehicle's side: messages to stations, changes of what is held, sentences for people.
//
// A `replaced` and a `cleared` say what is held from now on. An atomic vehicle is told of nothing before that; on one
// that is not, `begun_replacing` comes with MISSION_COUNT: the plan that was there is cut, and must not be flown on.
// Thread: values. Source: MAVLink mission protocol.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"

namespace godwit::ground_port::mission_server {

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
