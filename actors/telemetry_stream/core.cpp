#include "actors/telemetry_stream/core.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "io/fields/json_text.hpp"
#include "io/mavlink/frame_meaning.hpp"
#include "io/time_units.hpp"

namespace godwit::telemetry_stream {
namespace {

namespace mavlink = io::mavlink;

using mavlink::units_a_degree;
constexpr double metres_of_mm = 1e-3;
constexpr double metres_of_cm = 1e-2;
constexpr double degrees_of_cdeg = 1e-2;
constexpr double volts_of_mv = 1e-3;
constexpr double amperes_of_ca = 1e-2;
constexpr double degrees_of_rad = 180 / std::numbers::pi;
constexpr double hdop_of_unit = 1e-2;
constexpr std::uint16_t unknown_u16 = 65535;
constexpr std::uint8_t unknown_u8 = 255;

template <class Update>
publication made(topic what, const Update& update) {
  return {what, io::to_json(update)};
}

// Appends NOW when it is another one than what was SHOWN last.
template <class Update>
void show_changed(publications& out, topic what, const Update& now, std::optional<Update>& shown) {
  if (shown == now)
    return;
  out.push_back(made(what, now));
  shown = now;
}

} // namespace

bool core::is_due(std::optional<std::int64_t>& last_ns, std::int64_t interval_ns, std::int64_t now_ns) {
  if (last_ns && now_ns - *last_ns < interval_ns)
    return false;
  last_ns = now_ns;
  return true;
}

publications core::take(const mavlink::global_position_int& m, std::int64_t now_ns) {
  if (!is_due(position_ns_, data_interval_ns, now_ns))
    return {};
  position_update update;
  update.latitude_deg = m.lat / units_a_degree;
  update.longitude_deg = m.lon / units_a_degree;
  update.altitude_m = m.relative_alt * metres_of_mm;
  update.altitude_msl_m = m.alt * metres_of_mm;
  update.ground_speed_mps = std::hypot(m.vx * metres_of_cm, m.vy * metres_of_cm);
  update.climb_mps = -m.vz * metres_of_cm;
  if (m.hdg != unknown_u16)
    update.heading_deg = m.hdg * degrees_of_cdeg;
  return {made(topic::position, update)};
}

publications core::take(const mavlink::attitude& m, std::int64_t now_ns) {
  if (!is_due(attitude_ns_, data_interval_ns, now_ns))
    return {};
  return {made(topic::attitude, attitude_update{static_cast<double>(m.roll) * degrees_of_rad,
                                                static_cast<double>(m.pitch) * degrees_of_rad,
                                                static_cast<double>(m.yaw) * degrees_of_rad})};
}

publications core::take(const mavlink::sys_status& m, std::int64_t now_ns) {
  if (!is_due(battery_ns_, battery_interval_ns, now_ns))
    return {};
  battery_update update;
  if (m.battery_remaining >= 0)
    update.remaining_percent = m.battery_remaining;
  if (m.voltage_battery != unknown_u16)
    update.voltage_v = m.voltage_battery * volts_of_mv;
  if (m.current_battery >= 0)
    update.current_a = m.current_battery * amperes_of_ca;
  return {made(topic::battery, update)};
}

publications core::take(const mavlink::gps_raw_int& m, std::int64_t now_ns) {
  if (!is_due(gps_ns_, gps_interval_ns, now_ns))
    return {};
  gps_update update;
  update.fix = m.fix_type;
  if (m.satellites_visible != unknown_u8)
    update.satellites = m.satellites_visible;
  if (m.eph != unknown_u16)
    update.hdop = m.eph * hdop_of_unit;
  if (m.h_acc != 0)
    update.accuracy_m = m.h_acc * metres_of_mm;
  return {made(topic::gps, update)};
}

publications core::take(const mavlink::home_position& m, std::int64_t) {
  publications result;
  show_changed(result, topic::home,
               home_update{m.latitude / units_a_degree, m.longitude / units_a_degree, m.altitude * metres_of_mm},
               home_);
  return result;
}

publications core::take(const vehicle_link::connection_changed& m, std::int64_t) { return {made(topic::link, m)}; }

publications core::take(const executor::flight_status& m, std::int64_t) {
  publications result;
  show_changed(
      result, topic::flight,
      flight_update{m.phase, m.cause, m.sentence, m.in_flight, m.is_armed, m.mode, m.preflight_report, m.state},
      flight_);
  show_changed(result, topic::authority, authority_update{m.authority}, authority_);
  show_changed(result, topic::progress,
               progress_update{m.mission_id, m.revision, m.generation, m.items, m.items_done, m.reports}, progress_);
  return result;
}

publications core::take(const executor::known_missions& m, std::int64_t) {
  publications result;
  show_changed(result, topic::missions, m, missions_);
  return result;
}

publications core::take(const executor::way_home_estimate& m, std::int64_t now_ns) {
  if (!is_due(way_home_ns_, battery_interval_ns, now_ns))
    return {};
  return {made(topic::way_home, m)};
}

publications core::take(const executor::heard_traffic& m, std::int64_t) { return {made(topic::traffic, m)}; }

publications core::take(const health::health_status& m, std::int64_t) { return {made(topic::health, m)}; }

publications core::take(const mapobjects_store::map_status& m, std::int64_t) {
  auto now = made(topic::map, m);
  if (now.data == map_)
    return {};
  map_ = now.data;
  return {std::move(now)};
}

publications core::take(const scan_controller::points& m, std::span<const std::uint64_t> pictured,
                        std::int64_t wall_ns) {
  return show_points(update_of(m, pictured, wall_ns));
}

publications core::take_no_points() {
  auto now = points_.value_or(points_update{});
  now.is_looking = false;
  now.shown.clear();
  now.waiting = 0;
  return show_points(now);
}

publications core::show_points(const points_update& now) {
  auto compared = now;
  for (auto& each : compared.shown)
    each.decide_until_ms = 0;
  if (points_ == compared)
    return {};
  points_ = std::move(compared);
  return {made(topic::points, now)};
}

publications core::beat() { return {made(topic::clock, clock_update{++beats_})}; }

std::string json_of(const log_update& said) { return io::to_json(said); }

points_update update_of(const scan_controller::points& m, std::span<const std::uint64_t> pictured,
                        std::int64_t wall_ns) {
  const auto described = [pictured](const scan_controller::point_view& each) {
    return point_of_interest{each.number,
                             each.class_group,
                             each.position.latitude_deg,
                             each.position.longitude_deg,
                             each.confidence,
                             each.has_moved,
                             std::ranges::find(pictured, each.number) != pictured.end(),
                             0,
                             each.by};
  };
  points_update result{true, m.mission_id, {}, {}, m.waiting};
  for (const auto& each : m.shown)
    result.shown.emplace_back(described(each)).decide_until_ms = wall_ns / ns_per_ms + each.decide_within_ms;
  for (const auto& each : m.confirmed)
    result.confirmed.push_back(described(each));
  return result;
}

} // namespace godwit::telemetry_stream
