// Whether the battery is low, or critical, for certain.
//
//   sample ──> believable? ──yes──> run below 25 %: since when, how many samples ──5 s and 3 samples──> low
//                  │                run below 15 %: the same                     ──5 s and 3 samples──> critical
//                  └──no: both runs begin anew, unknown
//
// A battery sags for a moment under load, and a gauge can jump; neither may end a flight. So a level counts only when
// all samples of some seconds agree, and a gauge that jumps is not believed until it has become steady again. Percent,
// -1 for unknown as in SYS_STATUS; monotonic nanoseconds. Thread: pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace godwit::failsafe {

inline constexpr std::int64_t battery_settle_ms = 5'000;
inline constexpr int battery_settle_samples = 3; // five seconds between two samples prove nothing
inline constexpr int battery_jump_points = 20;   // within a second; no battery loses that much
inline constexpr std::int64_t battery_stale_ms = 10'000;

// Of the last second. A gauge that says more than this is heard with its newest ones only.
inline constexpr std::size_t max_battery_samples = 64;

struct battery_verdict {
  bool known = false; // false: no verdict
  int percent = -1;
  bool critical = false;
  bool low = false;
};

class battery_filter {
public:
  battery_filter(int critical_percent, int low_percent)
      : critical_{.threshold = critical_percent}, low_{.threshold = low_percent} {}

  void on_sample(int percent, std::int64_t now_ns);
  [[nodiscard]] battery_verdict judge(std::int64_t now_ns) const;

private:
  struct sample {
    int percent = 0;
    std::int64_t at_ns = 0;
  };

  // Samples one after the other at or below the threshold.
  struct run {
    int threshold = 0;
    std::optional<std::int64_t> since_ns = {};
    int samples = 0;

    void take(const sample& one);
    void end();
    [[nodiscard]] bool holds(std::int64_t now_ns) const;
  };

  [[nodiscard]] bool jumps(const sample& one) const;
  void forget_before(std::int64_t at_ns); // but for the newest
  void remember(const sample& one);
  void distrust();

  run critical_;
  run low_;
  std::deque<sample> recent_; // the newest, and all others of the last second
  std::optional<std::int64_t> last_ns_;
  bool known_ = false;
};

} // namespace godwit::failsafe
