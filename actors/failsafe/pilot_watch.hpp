// Who flies: godwit, or somebody else.
//
//             ┌──a mode that nobody of ours expects, or the executor says so──┐
//             │                                                               v
//   ──> ours ─┘                                                          a pilot
//             ^                                                               │
//             └───────────hand-back by an operator, end of the flight─────────┘
//
// A mode change in flight that no command of ours caused is a pilot, and godwit never fights one. The executor says
// which changes are ours before they happen. Without an executor this errs to the side of silence: the autopilot's own
// failsafes are still there. Two changes are always ours, because what we asked for leads to them: a return that lands,
// and a take-off that goes on.
// After a restart the mode is compared with the last one that was ours. Without such a record a vehicle in the air is
// only taken for ours when it flies a mission. On the ground modes change as they like. Thread: pure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "actors/failsafe/flight_watch.hpp"
#include "actors/failsafe/instant.hpp"
#include "actors/failsafe/rules.hpp"
#include "actors/failsafe/vehicle.hpp"
#include "io/fields/field_table.hpp"

namespace godwit::failsafe {

// Longer than three tries of a command take, and their effect in a heartbeat.
inline constexpr std::int64_t max_expectation_ms = 60'000;

inline constexpr std::size_t mode_kinds = enum_names(mode_kind{}).size();

struct expected_mode {
  mode_kind kind = mode_kind::unknown;
  std::optional<std::int64_t> until_ns; // wall clock; absent: to the end of the flight

  static constexpr auto fields = io::table("failsafe.expected_mode", io::field("kind", &expected_mode::kind),
                                           io::field("until_ns", &expected_mode::until_ns));
  friend bool operator==(const expected_mode&, const expected_mode&) = default;
};

struct pilot_memory {
  std::optional<flight_mode> ours; // the last mode that was
  bool taken_over = false;
  std::vector<expected_mode> expected; // at most one for each kind

  static constexpr auto fields =
      io::table("failsafe.pilot_memory", io::field("ours", &pilot_memory::ours),
                io::field("taken_over", &pilot_memory::taken_over), io::field("expected", &pilot_memory::expected));
  friend bool operator==(const pilot_memory&, const pilot_memory&) = default;
};

class pilot_watch {
public:
  pilot_watch(const pilot_memory& restored, instant now);

  // Nothing: to the end of the flight, or until a failsafe acts.
  void expect(mode_kind kind, std::optional<std::int64_t> lasts_ms, instant now);
  // A failsafe acts: from here on the plan leads nowhere by itself.
  void forget_the_plan();
  void take_over() { taken_over_ = true; }
  void hand_back();

  // Once at each tick at which the vehicle is heard. REACTS: what the failsafe itself is doing.
  void evaluate(const flight_now& flight, const flight_mode& mode, std::optional<action> reacts, instant now);

  [[nodiscard]] bool is_taken_over() const { return taken_over_; }
  [[nodiscard]] pilot_memory memory() const;

private:
  struct expectation {
    std::optional<std::int64_t> until_ns;
    std::optional<std::int64_t> until_monotonic_ns;
  };

  [[nodiscard]] bool is_expected(mode_kind kind) const;
  [[nodiscard]] bool is_ours(const flight_now& flight, const flight_mode& mode) const;
  void expire(instant now);

  std::optional<flight_mode> ours_;
  bool taken_over_ = false;
  bool adopts_ = false; // handed back: whatever mode comes next is ours
  std::array<std::optional<expectation>, mode_kinds> expected_;
};

} // namespace godwit::failsafe
