// Signs on the vehicle's line that somebody else acts, and the look at the vehicle before an order that moves it.
//
// A vehicle acknowledges a command to whoever sent it. ArduPilot sends that on the sender's own line, PX4 on every line
// where the sender was seen; so what is heard here is sure, and what is not heard says nothing. Times: monotonic
// nanoseconds. Thread: plain values. Source: COMMAND_ACK (77), MISSION_ACK (47), MISSION_REQUEST(_INT) (40, 51) to
// somebody else; MISSION_COUNT (44), MISSION_CLEAR_ALL (45), MISSION_SET_CURRENT (41) of somebody else.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/mission/place.hpp"

namespace godwit::vehicle_link {

enum class foreign_kind {
  command, // the vehicle does what somebody else told it
  plan     // somebody else brings it another plan, or has
};

GODWIT_ENUM_NAMES(foreign_kind, command, plan);

// Not about commands that this process has forwarded for a ground station: their answers are judged by ground_port.
struct foreign_act {
  foreign_kind kind = foreign_kind::command;
  std::uint16_t command = 0;  // MAV_CMD as the vehicle acknowledges it; 0: of a plan
  std::uint8_t system = 0;    // who did it; 0: the vehicle does not say
  std::uint8_t component = 0; // the same
  std::int64_t at_ns = 0;     // when it was heard; never the same twice
  GODWIT_FIELDS(foreign_act, "vehicle_link.foreign_act", kind, command, system, component, at_ns);
};

// A picture was taken, or failed, as the autopilot or a camera of its system reports it. Source: CAMERA_FEEDBACK (180),
// CAMERA_IMAGE_CAPTURED (263).
struct picture_taken {
  std::int32_t index = 0; // as its sender counts
  bool is_good = true;
  std::optional<mission::vertex> at = {}; // where; absent: it does not say
  GODWIT_FIELDS(picture_taken, "vehicle_link.picture_taken", index, is_good, at);
};

// Asks the vehicle for a heartbeat, and is answered when one has come that it sent after it was asked: HEARTBEATs that
// came before are told to listeners before the answer. A newer look takes the place of one that waits.
struct look {
  static constexpr auto fields = io::table("vehicle_link.look");
};

struct looked {
  bool is_seen = false;
  std::int64_t at_ns = 0; // when that heartbeat came
  std::string reason;     // sentence for people; empty when seen
  GODWIT_FIELDS(looked, "vehicle_link.looked", is_seen, at_ns, reason);
};

// While a flight is started the vehicle is asked for five heartbeats a second, and for one again afterwards. No copy of
// an order of the start goes out after it.
struct watch_closely {
  bool is_close = false;
  GODWIT_FIELDS(watch_closely, "vehicle_link.watch_closely", is_close);
};

// A message that is passed between the vehicle's line and that of the ground stations, as it was said.
//
// godwit does not read what is in it, or has read it and let it pass: what may pass is decided where it comes in
// (actors/vehicle_link/relay_gate.hpp, actors/ground_port/passing/table.hpp). It is numbered and signed anew on the
// other line, and keeps who said it. Thread: plain values.
struct relayed_frame {
  std::uint32_t message = 0;  // MAVLink's id of it
  std::uint8_t system = 0;    // who said it
  std::uint8_t component = 0; // the same
  std::vector<std::uint8_t> payload;
  GODWIT_FIELDS(relayed_frame, "vehicle_link.relayed_frame", message, system, component, payload);
  friend bool operator==(const relayed_frame&, const relayed_frame&) = default;
};

} // namespace godwit::vehicle_link
