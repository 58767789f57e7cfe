// Other aircraft that the vehicle, or a receiver on it, hears of, as seen from the vehicle; and what its autopilot
// warns of. For people: nothing is flown by it. What is not known is absent. Metres, m/s, degrees clockwise from north,
// seconds; altitudes above mean sea level. Told once a second while there is any, and asked for. Thread: plain values.
// Source: ADSB_VEHICLE (246), COLLISION (247) of MAVLink's common.xml.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"

namespace godwit::executor {

struct get_traffic {
  static constexpr auto fields = io::table("executor.get_traffic");
};

struct heard_aircraft {
  std::uint32_t icao = 0;
  std::string name;        // its callsign, or its address
  double latitude_deg = 0; // now, by its course
  double longitude_deg = 0;
  double age_s = 0; // of its newest report
  std::optional<double> altitude_m;
  std::string altitude_by; // pressure, geometric, empty: by air pressure it may be off by a hundred metres
  std::optional<double> course_deg;
  std::optional<double> speed_mps;
  std::optional<double> climb_mps;
  std::optional<double> distance_m; // over the ground; absent: where the vehicle is, is not known
  std::optional<double> height_m;   // above the vehicle; below 0: lower
  std::optional<double> closest_in_s;
  std::optional<double> closest_m;
  bool is_close = false; // or comes close soon, by the limits that are set
  std::string sentence;  // for people
  GODWIT_FIELDS(heard_aircraft, "executor.heard_aircraft", icao, name, latitude_deg, longitude_deg, age_s, altitude_m,
                altitude_by, course_deg, speed_mps, climb_mps, distance_m, height_m, closest_in_s, closest_m, is_close,
                sentence);
  friend bool operator==(const heard_aircraft&, const heard_aircraft&) = default;
};

struct heard_traffic {
  std::vector<heard_aircraft> aircraft; // the nearest first
  std::vector<std::string> warnings;    // of the autopilot, as sentences
  std::uint64_t without_place = 0;      // reports dropped since the start
  std::uint64_t without_room = 0;       // the same, of aircraft that are farther away than those listed
  GODWIT_FIELDS(heard_traffic, "executor.heard_traffic", aircraft, warnings, without_place, without_room);
  friend bool operator==(const heard_traffic&, const heard_traffic&) = default;
};

} // namespace godwit::executor
