// Every decision about points of interest.
//
//   candidate ──> the same place and class? ──> opened, seen again, or nothing new
//   time ──> next_due: a window is over; nobody looks for it any more; the best that waits has its turn
//   a person ──> decide: of a point that is shown, before its window is over
//
// In any rolling 60 s at most `shown_a_minute` points are shown; the window is the same for all, so with the defaults
// at most five wait for a person at a time. What is above the threshold is shown, or dropped with a reason that is
// counted. What comes back are facts, which the caller applies (state.hpp) before the next call. The state is all that
// it depends on, but for where the vehicle is. Pure. Thread: one at a time.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "actors/domain/geo/point.hpp"
#include "actors/scan_controller/point.hpp"
#include "actors/scan_controller/settings.hpp"
#include "actors/scan_controller/state.hpp"
#include "io/time_units.hpp"
#include "messages/scan_controller/types.hpp"

namespace godwit::scan_controller {

class core {
public:
  static constexpr std::int64_t never_ns = std::numeric_limits<std::int64_t>::max();
  // A point that is seen all the time is not written so often, if nothing but that is new.
  static constexpr std::int64_t refresh_ns = 5'000'000'000;
  static constexpr double refresh_m = 5;

  explicit core(settings configured) : settings_(std::move(configured)) {}

  void on_vehicle_at(const geo::point& here) { vehicle_ = here; }

  // A new incarnation begins.
  [[nodiscard]] static std::optional<fact> on_start(const state& s, instant now);

  struct judged {
    std::vector<fact> facts;
    candidate_answer answer;
  };
  [[nodiscard]] judged on_candidate(const state& s, const candidate& seen, instant now) const;

  struct decided {
    std::optional<fact> what;
    decide_answer answer;
  };
  [[nodiscard]] static decided on_decision(const state& s, const decide_point& said, instant now);

  // What is due now, one after the other: to be asked until there is nothing.
  [[nodiscard]] std::optional<fact> next_due(const state& s, instant now) const;
  // When something will be; never_ns: nothing.
  [[nodiscard]] std::int64_t next_deadline_ns(const state& s) const;

  [[nodiscard]] static points view_of(const state& s, instant now);

private:
  [[nodiscard]] judged open(const state& s, const candidate& seen, std::uint64_t again, bool is_first,
                            instant now) const;
  [[nodiscard]] ranked rank(const point& what, std::int64_t now_ns) const;
  [[nodiscard]] bool is_above(const point& what) const { return what.confidence >= settings_.min_confidence; }
  [[nodiscard]] std::int64_t keep_ns() const { return settings_.keep_ms * 1'000'000; }
  // From then on the next point may be shown.
  [[nodiscard]] std::int64_t next_turn_ns(const state& s) const;
  [[nodiscard]] const point* best_waiting(const state& s, std::int64_t now_ns) const;

  settings settings_;
  std::optional<geo::point> vehicle_; // none: not heard yet
};

} // namespace godwit::scan_controller
