// What a failsafe that has just started asks the vehicle to say at once, because the streams bring it only within a
// second: who it is and in which mode, whether it is in the air, where, and how much is left in the battery. Its home
// comes by itself within five seconds only; the executor plans nothing in flight before it knows that.
//
// REQUEST_MESSAGE, one at a time: the autopilot knows one command of a kind in flight. What comes by itself meanwhile
// is not asked for. Two positions are wanted: one outside of a fence proves nothing yet (fence_watch.hpp). A vehicle
// that does not answer is left to its streams. Thread: pure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "actors/failsafe/events.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "io/mavlink/messages/mission.hpp"
#include "io/mavlink/messages/position.hpp"

namespace godwit::failsafe {

// Of each message. The streams bring it soon in any case.
inline constexpr int max_look_tries = 3;

struct wanted_message {
  std::uint32_t message_id = 0;
  int tries_left = 0;
  int needed = 1;        // how many of it say something
  bool is_asked = false; // since the last tick
};

class first_look {
public:
  // Everything is asked for anew.
  void begin() { wanted_ = all; }
  void heard(std::uint32_t message_id);

  // Which message to ask for now. None: one is being asked for, or all have been heard or given up. Each is asked for
  // once between two ticks: what was answered may still be on its way, and a second one at once would say the same.
  [[nodiscard]] std::optional<std::uint32_t> next(bool at_tick);
  // What was asked for has an answer, or has none.
  void resolved() { asking_ = false; }

private:
  static constexpr std::array all{wanted_message{io::mavlink::heartbeat::message_id, max_look_tries},
                                  wanted_message{io::mavlink::extended_sys_state::message_id, max_look_tries},
                                  wanted_message{io::mavlink::global_position_int::message_id, max_look_tries, 2},
                                  wanted_message{io::mavlink::sys_status::message_id, max_look_tries},
                                  wanted_message{io::mavlink::home_position::message_id, max_look_tries}};

  std::array<wanted_message, all.size()> wanted_{};
  bool asking_ = false;
};

// What the vehicle's messages mean to the failsafe.
//
// The battery is what SYS_STATUS says, and nothing else: two gauges that differ would look like one that jumps.
// Heights are above home, which PX4 and ArduPilot set where they arm. Thread: pure. Source: MAVLink's common.xml.

[[nodiscard]] heartbeat sense(const io::mavlink::heartbeat& m);
[[nodiscard]] modes_told sense(const io::mavlink::current_mode& m);
[[nodiscard]] landed sense(const io::mavlink::extended_sys_state& m);
[[nodiscard]] position sense(const io::mavlink::global_position_int& m);
[[nodiscard]] home_told sense(const io::mavlink::home_position& m);
[[nodiscard]] battery sense(const io::mavlink::sys_status& m);
[[nodiscard]] autopilot_text sense(const io::mavlink::statustext& m);
[[nodiscard]] mission_current sense(const io::mavlink::mission_current& m);

} // namespace godwit::failsafe
