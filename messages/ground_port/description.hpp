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
  static constexpr auto fields = io::table("ground_port.heard_station", io::field("system", &heard_station::system),
                                           io::field("component", &heard_station::component),
                                           io::field("is_ground_station", &heard_station::is_ground_station),
                                           io::field("last_frame_age_ms", &heard_station::last_frame_age_ms),
                                           io::field("last_heartbeat_age_ms", &heard_station::last_heartbeat_age_ms));
};

struct shown_plan {
  std::string type; // mission, fence, rally
  std::uint32_t plan_id = 0;
  std::uint32_t items = 0;
  static constexpr auto fields =
      io::table("ground_port.shown_plan", io::field("type", &shown_plan::type),
                io::field("plan_id", &shown_plan::plan_id), io::field("items", &shown_plan::items));
};

// A number that only rises, under the name of what it counts.
struct port_count {
  std::string name;
  std::uint64_t count = 0;
  static constexpr auto fields =
      io::table("ground_port.port_count", io::field("name", &port_count::name), io::field("count", &port_count::count));
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
  static constexpr auto fields =
      io::table("ground_port.port_description", io::field("link_is_up", &port_description::link_is_up),
                io::field("reason", &port_description::reason), io::field("system", &port_description::system),
                io::field("component", &port_description::component),
                io::field("autopilot_heard", &port_description::autopilot_heard),
                io::field("signing_enabled", &port_description::signing_enabled),
                io::field("transfer", &port_description::transfer), io::field("stations", &port_description::stations),
                io::field("plans", &port_description::plans), io::field("counts", &port_description::counts));
};

} // namespace godwit::ground_port
