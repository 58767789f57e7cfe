// All that is said to and by ground_port. Times in milliseconds and nanoseconds. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/ground_port/mission.hpp"

namespace godwit::ground_port {

// How the port is: which stations are there, what goes on, and what was refused or dropped. Thread: plain values.
struct get_port {
  static constexpr auto fields = io::table("ground_port.get_port");
};

struct heard_station {
  std::uint8_t system = 0;
  std::uint8_t component = 0;
  bool is_ground_station = false; // it says so in its heartbeat
  std::int64_t last_frame_age_ms = -1;
  std::int64_t last_heartbeat_age_ms = -1; // -1: none yet
  GODWIT_FIELDS(heard_station, "ground_port.heard_station", system, component, is_ground_station, last_frame_age_ms,
                last_heartbeat_age_ms);
};

struct shown_plan {
  std::string type; // mission, fence, rally
  std::uint32_t plan_id = 0;
  std::uint32_t items = 0;
  GODWIT_FIELDS(shown_plan, "ground_port.shown_plan", type, plan_id, items);
};

// A number that only rises, under the name of what it counts.
struct port_count {
  std::string name;
  std::uint64_t count = 0;
  GODWIT_FIELDS(port_count, "ground_port.port_count", name, count);
};

struct port_description {
  bool link_is_up = false;
  std::string reason;           // sentence for people; empty when all is well
  std::uint8_t system = 0;      // as whom we speak
  std::uint8_t component = 0;   // the same
  bool autopilot_heard = false; // the autopilot itself speaks on this port
  bool signing_enabled = false;
  std::string transfer; // idle, receiving, giving
  std::vector<heard_station> stations;
  std::vector<shown_plan> plans;
  std::vector<port_count> counts;
  GODWIT_FIELDS(port_description, "ground_port.port_description", link_is_up, reason, system, component,
                autopilot_heard, signing_enabled, transfer, stations, plans, counts);
};

// Whether the human's ground station is heard: what the failsafe about a lost operator goes by.
//
// Heard means a heartbeat of a station that says that it is one (MAV_TYPE_GCS), and that may be believed where the link
// is signed. Told once a second, so that a listener also notices when ground_port itself is silent. What the age means
// (degraded, lost, never seen) is the listener's to decide. It has to remember
// that one was ever heard, and to go on counting: a port that was restarted knows nothing of its earlier life. Thread:
// plain values.
struct operator_link {
  bool ever_heard = false;
  std::int64_t age_ms = -1;   // since the last heartbeat of any station; -1: never heard
  std::uint32_t stations = 0; // heard within the last 5 s
  GODWIT_FIELDS(operator_link, "ground_port.operator_link", ever_heard, age_ms, stations);
};

// What the link's thread and the timers say to ground_port: nothing that anybody else needs. Thread: plain values.

// Something has come in; it waits in the arrivals of the line, not in the mailbox.
struct wake {
  static constexpr auto fields = io::table("ground_port.wake");
};

} // namespace godwit::ground_port
