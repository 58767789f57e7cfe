// When MISSION_CURRENT is due: once a second, and at once when what it says has changed.
//
//   if (const auto message = report.due(view, now_ns)) send(*message);
//
// Changes that follow each other faster than min_gap are told in one. Pure. Thread: one at a time. Source:
// MISSION_CURRENT (42).
#pragma once

#include <cstdint>
#include <optional>

#include "io/mavlink/messages/mission.hpp"

namespace godwit::ground_port::vehicle_role {

class current_report {
public:
  static constexpr std::int64_t period_ns = 1'000'000'000;
  static constexpr std::int64_t min_gap_ns = 20'000'000; // well below the 100 ms in which a change has to be seen

  // PERIOD, and ON_CHANGE false: only that, as ArduPilot does.
  explicit current_report(std::int64_t period = period_ns, bool on_change = true)
      : period_ns_(period), on_change_(on_change) {}

  // NOW what the message would say. Nothing: it is not due.
  [[nodiscard]] std::optional<io::mavlink::mission_current> due(const io::mavlink::mission_current& now_says,
                                                                std::int64_t now_ns);
  // A change is noticed when due() is called after it.
  [[nodiscard]] std::int64_t next_due_ns() const { return next_ns_; }

  // A station asked for another period (SET_MESSAGE_INTERVAL). 0: only changes are told.
  void set_period(std::int64_t wanted_ns, std::int64_t now_ns);

private:
  std::int64_t period_ns_;
  bool on_change_;
  std::optional<io::mavlink::mission_current> said_;
  std::int64_t said_ns_ = 0;
  std::int64_t next_period_ns_ = 0;
  std::int64_t next_ns_ = 0;
};

} // namespace godwit::ground_port::vehicle_role
