#include "programs/godwit-sim/vehicle/other_aircraft.hpp"

#include <cmath>
#include <string>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame_meaning.hpp"

namespace godwit::sim {
namespace {

using io::mavlink::adsb_flag;
using io::mavlink::number;

constexpr double leg_m = 8'000;
constexpr std::uint32_t first_icao = 0x4B0000;

} // namespace

io::mavlink::adsb_vehicle other_aircraft(const position& home, int index, double world_s) {
  const double course_deg = std::fmod(40 + 67.0 * index, 360);
  const double speed_mps = 30 + 5 * (index % 10);
  const double beside_m = 150.0 * index;
  const double along_m = std::fmod(speed_mps * world_s + 1'000 * index, leg_m) - leg_m / 2;
  const auto at = moved(moved(home, {course_deg, along_m}), {course_deg + 90, beside_m});
  io::mavlink::adsb_vehicle result;
  result.icao_address = first_icao + static_cast<std::uint32_t>(index);
  result.lat = static_cast<std::int32_t>(std::lround(at.latitude_deg * io::mavlink::units_a_degree));
  result.lon = static_cast<std::int32_t>(std::lround(at.longitude_deg * io::mavlink::units_a_degree));
  const auto callsign = "SIM" + std::to_string(index);
  callsign.copy(result.callsign.data(), result.callsign.size() - 1);
  result.flags = number(adsb_flag::valid_coords) | number(adsb_flag::valid_callsign);
  if (index % 3 == 2)
    return result;
  result.altitude = static_cast<std::int32_t>(std::lround((home.altitude_m + 60 + 40 * (index % 3)) * 1'000));
  result.heading = static_cast<std::uint16_t>(std::lround(course_deg * 100));
  result.hor_velocity = static_cast<std::uint16_t>(std::lround(speed_mps * 100));
  result.flags |= number(adsb_flag::valid_altitude) | number(adsb_flag::valid_heading) |
                  number(adsb_flag::valid_velocity) | number(adsb_flag::vertical_velocity_valid);
  return result;
}

} // namespace godwit::sim
