// How near another aircraft comes, when both go on in straight lines. For people: nothing is flown by it.
//
//   other's place, carried on to now ──> relative place and velocity ──> closest point; inside of the limits?
//
// An ADS-B receiver marks what it does not know; that is absent here, never 0: of an unknown height every height counts
// as near, and of an unknown course only the place counts. Metres, m/s, degrees clockwise from north, seconds;
// altitudes above mean sea level, those by air pressure as well, which may be off by a hundred metres. Times: monotonic
// nanoseconds. Thread: pure. Source: ADSB_VEHICLE (246) of MAVLink's common.xml.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "actors/domain/geo/point.hpp"
#include "io/fields/field_table.hpp"
#include "io/mavlink/messages/traffic.hpp"

namespace godwit::traffic {

enum class altitude_source { pressure, geometric };

GODWIT_ENUM_NAMES(altitude_source, pressure, geometric);

struct aircraft {
  std::uint32_t icao = 0;
  std::string name; // its callsign, or its address
  geo::point at;    // at seen_ns
  std::optional<double> altitude_m;
  altitude_source altitude_by = altitude_source::pressure;
  std::optional<double> course_deg;
  std::optional<double> speed_mps;
  std::optional<double> climb_mps;
  std::int64_t seen_ns = 0;
};

// None: it has no place that is one.
[[nodiscard]] std::optional<aircraft> aircraft_of(const io::mavlink::adsb_vehicle& m, std::int64_t now_ns);

// "ICAO 4B1234"
[[nodiscard]] std::string address_text(std::uint32_t icao);

// The place to which it has come by NOW_NS; without a course or a speed: where it was seen.
[[nodiscard]] geo::point place_of(const aircraft& other, std::int64_t now_ns);

struct own_motion {
  geo::point at;
  double altitude_m = 0;
  double north_mps = 0;
  double east_mps = 0;
  double climb_mps = 0;
};

// It is close that comes nearer than both within the time.
struct limits {
  double distance_m = 1'000; // over the ground
  double height_m = 150;
  double time_s = 60;
};

inline constexpr double max_ahead_s = 600; // nobody flies straight on for longer

struct closest_point {
  double in_s = 0; // at most max_ahead_s
  double distance_m = 0;
};

struct approach {
  double distance_m = 0;              // now
  double bearing_deg = 0;             // of the other one, from ours
  std::optional<double> height_m;     // of the other one above ours
  std::optional<closest_point> point; // absent: how it moves is not known
  bool is_close = false;
};

[[nodiscard]] approach approach_of(const own_motion& own, const aircraft& other, const limits& set,
                                   std::int64_t now_ns);

// "SWR123, 800 m to the north-east, 60 m higher, closest in 25 s at 120 m"
[[nodiscard]] std::string sentence_about(const std::string& name, const approach& how);

} // namespace godwit::traffic
