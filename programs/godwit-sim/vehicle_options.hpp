// The options of `godwit-sim vehicle`: as they are typed, and what they mean for the host.
//
// Errors: a sentence that names the option, the value and the allowed form. Thread: pure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "io/link/uri.hpp"
#include "programs/godwit-sim/host/vehicle_host.hpp"
#include "programs/godwit-sim/vehicle/autopilot/outlet.hpp"

namespace godwit::sim {

// Limits that are sentences for people elsewhere; a thousand vehicles are what one core can run.
inline constexpr int max_vehicles = 1'000;
inline constexpr std::size_t max_lines = outlet::max_lines; // of one vehicle
inline constexpr double min_speed = 0.1;
inline constexpr double max_speed = 100;
// Stations keep 251 to 255 for themselves, as a rule.
inline constexpr int max_system = 250;
// Between vehicles that start together: rows of so many, so far apart.
inline constexpr int vehicles_in_row = 32;
inline constexpr double distance_between_homes_m = 5;

struct vehicle_arguments {
  std::string personality;
  std::vector<std::string> links = {"udpout://127.0.0.1:14550"}; // where QGroundControl listens; one for each line
  std::string home = "47.397742,8.545594,488";
  double speed = 1;
  std::uint64_t seed = 1;
  int system = 1;
  int count = 1;
  double battery = 100;
  std::string faults = "none";
  std::vector<std::string> fault_at;
  std::vector<std::string> refuse;
  std::string control;
  std::string camera;
  std::string camera_truth;
  int aircraft = 0;
  bool has_payload = false;
  bool arm_on_start = false;
  std::string tlog;
  bool quiet = false;
};

[[nodiscard]] tl::expected<host_settings, std::string> read(const vehicle_arguments& given);

// The system id of the vehicle NUMBER, counted from 0: they rise from FIRST and begin again at 1 after max_system.
[[nodiscard]] std::uint8_t system_of(int first, int number);

// Where the vehicle NUMBER has its link. Those that listen take the ports from WHERE's on; those that call all call the
// same place.
[[nodiscard]] tl::expected<io::link::uri, std::string> link_of(const io::link::uri& where, int number);

// Where the vehicle NUMBER begins.
[[nodiscard]] position home_of(const position& first, int number);

// How to reach a simulated vehicle with the ground stations that people use. Thread: pure. Source: the manuals of
// QGroundControl, MAVProxy and MAVSDK.

// A line for each, for the link WHERE of a vehicle, with its port as it is.
[[nodiscard]] std::vector<std::string> connection_hints(const io::link::uri& where);

} // namespace godwit::sim
