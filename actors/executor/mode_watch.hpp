// Who flies: a mode change in flight that no word of ours has caused is a pilot's.
//
// Ours are the modes that godwit has asked for (for expected_for_ns after it asked), those into which the plan leads by
// itself at its end, and those that a failsafe of ours has asked for. The mode in which a flight is found is adopted,
// when the flight was ours. Thread: pure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "messages/flight/flight_mode.hpp"

namespace godwit::executor {

using flight::flight_mode;
using flight::mode_kind;

// A vehicle changes its mode within a heartbeat of its answer; a slow link delays both.
inline constexpr std::int64_t expected_for_ns = 5'000'000'000;

class mode_watch {
public:
  // Before the word goes out.
  void expect(mode_kind kind, std::int64_t now_ns);
  // While the plan ends, holding, returning and landing are its own doing.
  void set_plan_end(bool ends) { plan_ends_ = ends; }
  void forget();

  // MODE is heard in flight. True: a pilot has taken the vehicle.
  [[nodiscard]] bool is_taken_over_by(const flight_mode& mode, std::int64_t now_ns);
  // Whatever it is now, it is ours.
  void adopt(const flight_mode& mode) { ours_ = mode; }

private:
  static constexpr std::size_t kinds = 8;
  [[nodiscard]] bool is_expected(mode_kind kind, std::int64_t now_ns) const;

  std::optional<flight_mode> ours_;
  bool plan_ends_ = false;
  std::array<std::int64_t, kinds> expected_until_ns_{};
};

} // namespace godwit::executor
