// How the port is: which stations are there, what goes on, and what was refused or dropped. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"

namespace godwit::ground_port {

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

} // namespace godwit::ground_port
