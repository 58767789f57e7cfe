// A simulated vehicle: what comes in are MAVLink frames and time, what goes out are MAVLink frames.
//
//   vehicle rover({.who = personality::rover, .home = {47.0, 8.0, 400.0}}, now_ns, send);
//   rover.on_frame(frame, now_ns);          // from any station
//   rover.on_time(now_ns);                  // no later than next_deadline_ns()
//
// Several lines may lead to it; station and godwit can be on the same one or on two:
//
//   const auto radio = rover.add_line(send_by_radio);
//   rover.on_frame(frame, now_ns, radio);
//
// It answers as the autopilot whose personality it has was seen to answer (see personality.hpp). The world (motion,
// battery, telemetry) runs `speed` times as fast as the time that comes in; the patience of transfers and commands does
// not, nor that of an autopilot that was armed and has not taken off, because who talks to it lives in real time.
// Everything random comes from the seed. Pure: no clock, no socket; it calls the SEND of a line with each frame, which
// goes to everybody who listens there. What is an answer goes out on the line of who asked, or where its autopilot
// sends it; what is asked for at an interval comes on that line alone. Bounds: outlet::max_lines. Thread: one at a
// time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/mavlink/frame.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"
#include "programs/godwit-sim/vehicle/personality.hpp"
#include "programs/godwit-sim/vehicle/world/position.hpp"

namespace godwit::sim {

struct vehicle_settings {
  personality who = personality::px4;
  std::uint8_t system = 1;
  position home{47.397742, 8.545594, 488.0};
  double speed = 1; // world seconds in a second
  std::uint64_t seed = 1;
  double battery_percent = 100;
  double endurance_s = 1'500; // of a full battery in flight; world time
  bool arms_on_start = false; // rover: MISSION_START arms
  double stream_factor = 1;   // rates of the default streams, times this
  // Of a plane: RTL_AUTOLAND. 0, ArduPilot's default: DO_LAND_START keeps it disarmed; 2: a return lands by it at once.
  int rtl_autoland = 3;
  bool has_payload = false;         // GRIP_ENABLE and CAM1_TYPE 1, or TRIG_MODE 4; off, as by default
  int aircraft = 0;                 // others, that a receiver on it reports; at most max_other_aircraft
  bool holds_when_landed = false;   // px4: as a VTOL of it was seen to, after the landing of a mission
  bool has_sticks = true;           // px4: a pilot's; off, the modes that need them can not be taken once it is armed
  bool beats_at_mode_change = true; // ardupilot, plane: off for what was recorded before they did
};

// For people, tests and the control port.
struct vehicle_picture {
  position where;
  double heading_deg = 0;
  double roll_rad = 0;
  double pitch_rad = 0;
  double ground_speed_mps = 0;
  std::string mode;
  bool armed = false;
  bool in_air = false;
  std::string mission_state; // idle, running, completed
  int mission_current = 0;
  int mission_count = 0;
  std::uint32_t mission_id = 0; // 0: none, or an autopilot without ids
  int fence_count = 0;          // items
  int rally_count = 0;
  double battery_percent = 0;
  bool has_position = true; // GPS
  std::optional<position> region_of_interest;
  std::int64_t world_ms = 0; // since the autopilot's start
};

class vehicle {
public:
  using frame_sink = std::function<void(std::span<const std::byte>)>;

  vehicle(const vehicle_settings& settings, std::int64_t now_ns, frame_sink send);
  vehicle(const vehicle&) = delete;
  vehicle& operator=(const vehicle&) = delete;
  ~vehicle();

  // Counted from 0; that of the constructor is 0.
  using line_number = std::size_t;
  // From now on it speaks there, too.
  line_number add_line(frame_sink send, std::int64_t now_ns);

  void on_frame(const io::mavlink::frame_view& frame, std::int64_t now_ns, line_number line = 0);
  void on_time(std::int64_t now_ns);
  [[nodiscard]] std::int64_t next_deadline_ns() const;

  // -- faults on demand
  void reboot(std::int64_t now_ns);                   // silent for a while, then its clock starts at 0
  void lose_position(bool lost, std::int64_t now_ns); // GPS
  void block(bool is_blocked, std::int64_t now_ns);   // something holds it where it is; not a fixed wing in the air
  void set_battery(double percent, std::int64_t now_ns);
  // PX4's GF_MAX_HOR_DIST, from home; 0: none. As with any parameter, a plan that it holds is not looked at anew.
  void limit_distance(double metres);
  void breach_fence(std::int64_t now_ns);                                     // of its own, an ArduPilot: it returns
  void say(std::string_view words, std::int64_t now_ns);                      // as a STATUSTEXT, a warning
  void refuse_command(std::uint16_t command, std::uint8_t result, int times); // times < 0: from now on; 0: no longer

  [[nodiscard]] vehicle_picture describe() const;
  // As it is held: an ArduPilot's item 0 is home.
  [[nodiscard]] const std::vector<io::mavlink::mission_item_int>& mission_items() const;

private:
  class parts;
  std::unique_ptr<parts> parts_;
};

} // namespace godwit::sim
