// Whether the vehicle keeps to its fences, by the positions that it reports.
//
// Each position is judged together with the way that led to it from the last one that was not outside. One position
// proves nothing: it may be a jump of the receiver, or made up. A breach is what a second position of another vehicle
// time says, too, at most two seconds later. A position that is older than a second says nothing of where the vehicle
// is now: no verdict. Where it will be in two seconds, at the speed that it
// has, is worth a warning and no more.
//
// A fence that keeps in may have a floor, and a vehicle that takes off or lands is below it. So floors count from the
// moment when the vehicle was first within all fences with their floors, and not while it takes off or lands.
// Monotonic nanoseconds. Thread: pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

#include "actors/domain/geofence/fence_set.hpp"
#include "actors/failsafe/events.hpp"

namespace godwit::failsafe {

inline constexpr std::int64_t position_stale_ms = 1'000;
inline constexpr std::int64_t confirmed_within_ms = 2'000;
inline constexpr double look_ahead_s = 2;

// Positions between two ticks. When more come, the way between them is drawn with fewer points.
inline constexpr std::size_t max_waiting_positions = 16;

using geofence::breach;

enum class fence_finding { no_fences, no_verdict, inside, breached };

struct fence_verdict {
  fence_finding finding = fence_finding::no_fences;
  std::optional<breach> found; // when breached
  std::optional<breach> ahead; // inside now, and not in look_ahead_s
};

class fence_watch {
public:
  // They count for positions that come from now on.
  void set(geofence::fence_set fences);
  void on_position(const position& reported, std::int64_t now_ns);
  void begin_flight() { floor_reached_ = false; }

  // Once at each tick. NEAR_GROUND: it takes off or lands.
  [[nodiscard]] fence_verdict evaluate(std::int64_t now_ns, bool near_ground);

private:
  struct fix {
    geofence::place there;
    std::int64_t at_ns = 0;
    std::uint32_t boot_ms = 0;
  };

  [[nodiscard]] std::optional<breach> judge_waiting(bool floor_counts);
  [[nodiscard]] bool is_confirmed_by(const fix& next) const;
  void forget_way();
  [[nodiscard]] geofence::place predicted() const;

  geofence::fence_set fences_;
  std::deque<fix> waiting_;    // not judged yet
  std::optional<fix> judged_;  // the newest that was inside, or that has confirmed a breach
  std::optional<fix> accused_; // the newest that was outside
  bool is_outside_ = false;    // confirmed
  position newest_;
  std::optional<std::int64_t> newest_ns_;
  bool floor_reached_ = false;
};

} // namespace godwit::failsafe
