// Which messages are streamed, how often, and which of them are due.
//
// The table is given once: each id with the interval that it has by default. A station changes an interval with
// SET_MESSAGE_INTERVAL (511), for ids of the table alone. Due times do not drift: a message that is late by more than
// its interval skips what it has missed. Pure. Thread: one at a time.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace godwit::ground_port::vehicle_role {

struct streamed_message {
  std::uint32_t id = 0;
  std::int64_t interval_ns = 0; // 0: not streamed by default
};

class message_schedule {
public:
  // 1 kHz: more often than any telemetry link carries.
  static constexpr std::int64_t min_interval_ns = 1'000'000;
  // What MESSAGE_INTERVAL can tell: 35 minutes.
  static constexpr std::int64_t max_interval_us = std::numeric_limits<std::int32_t>::max();

  // The first due times are spread over each interval by PHASE (0 to 1), so that a thousand vehicles do not speak at
  // the same instant.
  message_schedule(std::span<const streamed_message> table, std::int64_t now_ns, double phase = 0);

  // As in SET_MESSAGE_INTERVAL: -1 stops it, 0 is the default, less than min_interval_ns counts as that. A new interval
  // begins at once. False: ID is not in the table, or the interval is below -1 or above max_interval_us.
  [[nodiscard]] bool set_interval(std::uint32_t id, std::int64_t interval_us, std::int64_t now_ns);
  // As in MESSAGE_INTERVAL (244): microseconds, -1 not streamed, 0 not known.
  [[nodiscard]] std::int32_t interval_us(std::uint32_t id) const;

  // Calls F(id) for each that is due.
  template <class F>
  void for_each_due(std::int64_t now_ns, F f) {
    if (now_ns < next_ns_)
      return;
    for (auto& each : entries_)
      if (each.interval_ns > 0 && now_ns >= each.due_ns) {
        each.due_ns = next_after(each, now_ns);
        f(each.id);
      }
    find_next();
  }
  [[nodiscard]] std::int64_t next_due_ns() const { return next_ns_; }

private:
  struct entry {
    std::uint32_t id = 0;
    std::int64_t default_interval_ns = 0;
    std::int64_t interval_ns = 0;
    std::int64_t due_ns = 0;
  };
  [[nodiscard]] static std::int64_t next_after(const entry& each, std::int64_t now_ns);
  void find_next();

  std::vector<entry> entries_;
  std::int64_t next_ns_ = std::numeric_limits<std::int64_t>::max();
};

} // namespace godwit::ground_port::vehicle_role
