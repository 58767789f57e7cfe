#include "actors/domain/traffic/traffic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string_view>

#include "actors/domain/geo/distance_text.hpp"
#include "actors/domain/geo/geodesic.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame_meaning.hpp"

namespace godwit::traffic {
namespace {

using io::mavlink::adsb_flag;

constexpr double s_of_ns = 1e-9;
constexpr double rad_of_deg = std::numbers::pi / 180;
constexpr double metres_of_mm = 1e-3;
constexpr double of_hundredths = 1e-2;
constexpr std::int64_t ns_per_s = 1'000'000'000;
constexpr std::uint16_t full_circle_cdeg = 36'000;
constexpr double same_height_m = 5;
constexpr double moves_away_s = 1; // the closest point is nearly past

bool is_valid(const io::mavlink::adsb_vehicle& m, adsb_flag what) { return (m.flags & io::mavlink::number(what)) != 0; }

// Letters and digits as a callsign has them; whatever else came in its bytes is left out.
std::string callsign_of(const io::mavlink::adsb_vehicle& m) {
  std::string result;
  for (const char each : m.callsign) {
    if (each == '\0')
      break;
    if ((each >= '0' && each <= '9') || (each >= 'A' && each <= 'Z') || (each >= 'a' && each <= 'z') || each == '-')
      result += each;
  }
  return result;
}

struct span_s {
  double from = 0;
  double to = 0;
};

constexpr span_s always{-max_ahead_s, max_ahead_s};
constexpr span_s never{1, 0};

span_s both(const span_s& a, const span_s& b) { return {std::max(a.from, b.from), std::min(a.to, b.to)}; }

// East and north of ours, and how that changes.
struct relative {
  double east_m = 0;
  double north_m = 0;
  double east_mps = 0;
  double north_mps = 0;

  [[nodiscard]] double speed_2() const { return east_mps * east_mps + north_mps * north_mps; }
  [[nodiscard]] double closing() const { return east_m * east_mps + north_m * north_mps; } // below 0: it comes nearer
};

span_s nearer_than(double distance_m, const relative& to) {
  const auto beyond = to.east_m * to.east_m + to.north_m * to.north_m - distance_m * distance_m;
  if (to.speed_2() == 0)
    return beyond <= 0 ? always : never;
  const auto root = to.closing() * to.closing() - to.speed_2() * beyond;
  if (root < 0)
    return never;
  return {(-to.closing() - std::sqrt(root)) / to.speed_2(), (-to.closing() + std::sqrt(root)) / to.speed_2()};
}

span_s within_height(double limit_m, const std::optional<double>& height_m, double climb_mps) {
  if (!height_m)
    return always;
  if (climb_mps == 0)
    return std::abs(*height_m) <= limit_m ? always : never;
  const auto [from, to] = std::minmax({(-limit_m - *height_m) / climb_mps, (limit_m - *height_m) / climb_mps});
  return {from, to};
}

std::string height_text(const std::optional<double>& height_m) {
  if (!height_m)
    return "height not known";
  if (std::abs(*height_m) < same_height_m)
    return "at the same height";
  return geo::distance_text(std::abs(*height_m)) + (*height_m > 0 ? " higher" : " lower");
}

} // namespace

std::string address_text(std::uint32_t icao) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "ICAO %06X", static_cast<unsigned>(icao));
  return text.data();
}

std::optional<aircraft> aircraft_of(const io::mavlink::adsb_vehicle& m, std::int64_t now_ns) {
  aircraft result;
  result.at = {m.lat / io::mavlink::units_a_degree, m.lon / io::mavlink::units_a_degree};
  if (!is_valid(m, adsb_flag::valid_coords) || !geo::is_valid(result.at))
    return std::nullopt;
  result.icao = m.icao_address;
  if (is_valid(m, adsb_flag::valid_callsign))
    result.name = callsign_of(m);
  if (result.name.empty())
    result.name = address_text(m.icao_address);
  if (is_valid(m, adsb_flag::valid_altitude))
    result.altitude_m = m.altitude * metres_of_mm;
  if (m.altitude_type != io::mavlink::altitude_pressure_qnh)
    result.altitude_by = altitude_source::geometric;
  if (is_valid(m, adsb_flag::valid_heading) && m.heading <= full_circle_cdeg)
    result.course_deg = m.heading * of_hundredths;
  if (is_valid(m, adsb_flag::valid_velocity))
    result.speed_mps = m.hor_velocity * of_hundredths;
  if (is_valid(m, adsb_flag::vertical_velocity_valid))
    result.climb_mps = m.ver_velocity * of_hundredths;
  result.seen_ns = now_ns - m.tslc * ns_per_s;
  return result;
}

geo::point place_of(const aircraft& other, std::int64_t now_ns) {
  if (!other.course_deg || !other.speed_mps)
    return other.at;
  const auto age_s = static_cast<double>(now_ns - other.seen_ns) * s_of_ns;
  return geo::destination(other.at, *other.course_deg, *other.speed_mps * age_s);
}

approach approach_of(const own_motion& own, const aircraft& other, const limits& set, std::int64_t now_ns) {
  const auto there = place_of(other, now_ns);
  approach result;
  result.distance_m = geo::distance_m(own.at, there);
  result.bearing_deg = geo::bearing_deg(own.at, there);
  const auto climb_mps = other.climb_mps.value_or(0);
  if (other.altitude_m)
    result.height_m =
        *other.altitude_m + climb_mps * static_cast<double>(now_ns - other.seen_ns) * s_of_ns - own.altitude_m;
  relative to{result.distance_m * std::sin(result.bearing_deg * rad_of_deg),
              result.distance_m * std::cos(result.bearing_deg * rad_of_deg), 0, 0};
  const bool is_motion_known = other.course_deg && other.speed_mps;
  if (is_motion_known) {
    to.east_mps = *other.speed_mps * std::sin(*other.course_deg * rad_of_deg) - own.east_mps;
    to.north_mps = *other.speed_mps * std::cos(*other.course_deg * rad_of_deg) - own.north_mps;
    const auto in_s = to.speed_2() == 0 ? 0 : std::clamp(-to.closing() / to.speed_2(), 0.0, max_ahead_s);
    result.point = {in_s, std::hypot(to.east_m + to.east_mps * in_s, to.north_m + to.north_mps * in_s)};
  }
  const span_s watched{0, is_motion_known ? set.time_s : 0};
  const auto inside = both(watched, both(nearer_than(set.distance_m, to),
                                         within_height(set.height_m, result.height_m, climb_mps - own.climb_mps)));
  result.is_close = inside.from <= inside.to;
  return result;
}

std::string sentence_about(const std::string& name, const approach& how) {
  auto result = name + ", " + geo::distance_text(how.distance_m) + " to the " +
                std::string(geo::direction_text(how.bearing_deg)) + ", " + height_text(how.height_m);
  if (!how.point)
    return result + ", course not known";
  if (how.point->in_s < moves_away_s)
    return result + ", not coming nearer";
  return result + ", closest in " + std::to_string(std::lround(how.point->in_s)) + " s at " +
         geo::distance_text(how.point->distance_m);
}

} // namespace godwit::traffic
