// What the stream shows of what it hears, and how often.
//
//   what vehicle, executor and others say ──take()──> publication, or nothing
//
// Of what comes many times a second (position, attitude, gps, battery, way_home) at most one in data_interval_ns is
// shown; what is told when it changes (flight, authority, progress, missions, home, link, map) is shown when it has
// changed. Pure: the time comes in, as monotonic nanoseconds. Thread: one owner.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/mavlink/messages/heartbeat.hpp"
#include "io/mavlink/messages/position.hpp"
#include "messages/executor/flight.hpp"
#include "messages/executor/known_missions.hpp"
#include "messages/executor/traffic.hpp"
#include "messages/health/types.hpp"
#include "messages/mapobjects_store/status.hpp"
#include "messages/scan_controller/point.hpp"
#include "messages/telemetry_stream/types.hpp"
#include "messages/vehicle_link/connection.hpp"

namespace godwit::telemetry_stream {

inline constexpr std::int64_t data_interval_ns = 100'000'000; // 10 a second: more than a person sees
inline constexpr std::int64_t gps_interval_ns = 500'000'000;
// Vehicles tell of it each second: no second one of these is left out because it came a moment early.
inline constexpr std::int64_t battery_interval_ns = 500'000'000;

struct publication {
  topic what = topic::clock;
  std::string data; // JSON
};

using publications = std::vector<publication>;

class core {
public:
  [[nodiscard]] publications take(const io::mavlink::global_position_int& m, std::int64_t now_ns);
  [[nodiscard]] publications take(const io::mavlink::attitude& m, std::int64_t now_ns);
  [[nodiscard]] publications take(const io::mavlink::sys_status& m, std::int64_t now_ns);
  [[nodiscard]] publications take(const io::mavlink::gps_raw_int& m, std::int64_t now_ns);
  [[nodiscard]] publications take(const io::mavlink::home_position& m, std::int64_t now_ns);
  [[nodiscard]] publications take(const vehicle_link::connection_changed& m, std::int64_t now_ns);
  [[nodiscard]] publications take(const executor::flight_status& m, std::int64_t now_ns);
  [[nodiscard]] publications take(const executor::known_missions& m, std::int64_t now_ns);
  [[nodiscard]] publications take(const executor::way_home_estimate& m, std::int64_t now_ns);
  [[nodiscard]] publications take(const executor::heard_traffic& m, std::int64_t now_ns);
  [[nodiscard]] publications take(const health::health_status& m, std::int64_t now_ns);
  [[nodiscard]] publications take(const mapobjects_store::map_status& m, std::int64_t now_ns);
  // PICTURED: the numbers of points that the camera has shown. WALL_NS: since 1970 (UTC).
  [[nodiscard]] publications take(const scan_controller::points& m, std::span<const std::uint64_t> pictured,
                                  std::int64_t wall_ns);
  [[nodiscard]] publications take_no_points(); // nobody looks for them
  [[nodiscard]] publications beat();

private:
  [[nodiscard]] static bool is_due(std::optional<std::int64_t>& last_ns, std::int64_t interval_ns, std::int64_t now_ns);
  [[nodiscard]] publications show_points(const points_update& now);

  std::optional<std::int64_t> position_ns_; // when it was shown last
  std::optional<std::int64_t> attitude_ns_;
  std::optional<std::int64_t> battery_ns_;
  std::optional<std::int64_t> gps_ns_;
  std::optional<home_update> home_;     // as shown last
  std::optional<flight_update> flight_; // as shown last
  std::optional<authority_update> authority_;
  std::optional<progress_update> progress_;
  std::optional<executor::known_missions> missions_;
  std::optional<std::int64_t> way_home_ns_; // when it was shown last
  std::string map_;
  std::optional<points_update> points_; // as shown last, without the ends of windows, which differ by a millisecond
  std::uint64_t beats_ = 0;
};

[[nodiscard]] std::string json_of(const log_update& said);
// As people see them; the same.
[[nodiscard]] points_update update_of(const scan_controller::points& m, std::span<const std::uint64_t> pictured,
                                      std::int64_t wall_ns);

} // namespace godwit::telemetry_stream
