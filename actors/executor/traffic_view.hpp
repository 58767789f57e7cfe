// What the vehicle reports of other aircraft, as seen from where it is. Nothing of it is durable: after a restart it is
// heard again within seconds. Times: monotonic nanoseconds. Pure. Thread: one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "actors/domain/traffic/sky.hpp"
#include "actors/domain/traffic/traffic.hpp"
#include "io/mavlink/messages/position.hpp"
#include "io/mavlink/messages/traffic.hpp"
#include "messages/executor/traffic.hpp"
#include "messages/mission/place.hpp"

namespace godwit::executor {

class traffic_view {
public:
  // Autopilots repeat a warning at least each 3 s.
  static constexpr std::int64_t warning_counts_ns = 10'000'000'000;
  static constexpr std::size_t max_warnings = 8; // the oldest makes room

  void take(const io::mavlink::global_position_int& m, std::int64_t now_ns);
  void take(const io::mavlink::adsb_vehicle& m, std::int64_t now_ns);
  void take(const io::mavlink::collision& m, std::int64_t now_ns);

  [[nodiscard]] heard_traffic all(const traffic::limits& set, std::int64_t now_ns) const;

  // The autopilot warns of a collision.
  struct warning {
    std::uint8_t source = 0;
    std::uint32_t id = 0;
    std::string name; // of the aircraft
    std::string sentence;
    std::int64_t heard_ns = 0;
  };
  [[nodiscard]] std::vector<warning> warnings(std::int64_t now_ns) const;

  // What comes close while the vehicle goes straight to TO, as fast as it is given, as a sentence; empty: nothing, or
  // where the vehicle is, is not known.
  [[nodiscard]] std::string on_way(const mission::position& to, double cruise_mps, traffic::limits set,
                                   std::int64_t now_ns) const;

private:
  struct seen {
    const traffic::aircraft* other = nullptr;
    std::optional<traffic::approach> how; // none: where ours is, is not known
  };
  [[nodiscard]] std::vector<seen> seen_from(const std::optional<traffic::own_motion>& from, const traffic::limits& set,
                                            std::int64_t now_ns) const;
  // None: not heard of late.
  [[nodiscard]] std::optional<traffic::own_motion> own(std::int64_t now_ns) const;
  [[nodiscard]] std::string name_of(std::uint8_t source, std::uint32_t id) const;

  traffic::sky sky_;
  std::optional<traffic::own_motion> own_;
  double above_home_m_ = 0;
  std::int64_t own_ns_ = 0;
  std::vector<warning> warnings_;
};

} // namespace godwit::executor
