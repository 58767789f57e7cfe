// The line between a vehicle and its stations, with the faults that it is told to have.
//
//   faulty_line line(seed, [](way to, auto frame, bool is_damaged) { ... });
//   line.set(*parse_line_faults("loss=0.1,delay=15ms"));
//   line.send(way::out, frame, now_ns);     // delivers it now, later, twice, damaged or not at all
//   line.on_time(now_ns);                   // no later than next_deadline_ns()
//
// What is sent are whole frames. Each way is for itself: settings, order, queue, counters. A frame that is under way
// when the line is cut is lost where the cut meets it, at its end. Deterministic: the same calls with the same seed
// deliver the same bytes at the same times. A good line copies nothing and delivers inside `send`.
// Pure: no clock, no socket. Thread: one at a time; DELIVER may send, and must not destroy.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "programs/godwit-sim/line/line_settings.hpp"
#include "runtime/random.hpp"

namespace godwit::sim {

enum class way : std::size_t { in = 0, out = 1 }; // towards the vehicle; from the vehicle

// Of frames, since the line was made.
struct line_counters {
  std::uint64_t sent = 0;
  std::uint64_t delivered = 0; // with duplicates and damaged ones
  std::uint64_t lost = 0;
  std::uint64_t duplicated = 0;
  std::uint64_t reordered = 0;
  std::uint64_t late = 0;
  std::uint64_t damaged = 0;
  std::uint64_t cut = 0;        // met a line that was cut
  std::uint64_t overflowed = 0; // there was no room for what is under way
  bool operator==(const line_counters&) const = default;
};

class faulty_line {
public:
  using receiver = std::function<void(way to, std::span<const std::byte> frame, bool is_damaged)>;

  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();
  // Under way, each way: a second of delay at ten times what a busy station and its vehicle say to each other.
  static constexpr std::size_t max_waiting = 1'024;
  // A frame that is to be overtaken waits longer than the next frames of a transfer take to come, and not as long as
  // autopilots wait before they ask again.
  static constexpr std::int64_t reorder_hold_ns = 50'000'000;
  // A late frame comes after the next heartbeat: a radio that was blocked has kept it.
  static constexpr std::int64_t late_hold_ns = 1'500'000'000;

  faulty_line(std::uint64_t seed, receiver deliver) : random_(seed), deliver_(std::move(deliver)) {}
  faulty_line(const faulty_line&) = delete;
  faulty_line& operator=(const faulty_line&) = delete;

  void set(const line_faults& faults) { ways_[0].settings = faults.in, ways_[1].settings = faults.out; }
  [[nodiscard]] line_faults faults() const { return {ways_[0].settings, ways_[1].settings}; }

  // Both ways or one, beside what the settings say; `never`: until it is restored.
  void cut(std::int64_t until_ns) { ways_[0].cut_until_ns = ways_[1].cut_until_ns = until_ns; }
  void cut(way to, std::int64_t until_ns) { of(to).cut_until_ns = until_ns; }
  // Ends every cut, also those of the settings.
  void restore();
  [[nodiscard]] bool is_cut(way to, std::int64_t now_ns) const {
    return now_ns < of(to).cut_until_ns || of(to).settings.is_cut;
  }

  void send(way to, std::span<const std::byte> frame, std::int64_t now_ns);
  void on_time(std::int64_t now_ns);
  [[nodiscard]] std::int64_t next_deadline_ns() const;
  [[nodiscard]] const line_counters& counters(way to) const { return of(to).counters; }

private:
  struct under_way {
    std::int64_t due_ns;
    std::uint64_t number; // of two at the same time the earlier one comes first
    bool is_damaged;
    std::vector<std::byte> frame;
  };
  struct one_way {
    line_settings settings;
    line_counters counters;
    std::vector<under_way> waiting; // a heap: the next one in front
    std::uint64_t numbered = 0;
    std::int64_t cut_until_ns = std::numeric_limits<std::int64_t>::min();
    std::int64_t in_order_ns = 0; // no frame comes before this, unless it is one that overtakes
  };

  [[nodiscard]] const one_way& of(way to) const { return ways_[static_cast<std::size_t>(to)]; }
  [[nodiscard]] one_way& of(way to) { return ways_[static_cast<std::size_t>(to)]; }
  [[nodiscard]] bool happens(double share) { return share > 0 && random_.unit() < share; }
  [[nodiscard]] std::int64_t due_ns(one_way& line, std::int64_t now_ns);
  // True if a bit was turned.
  bool damage(std::span<std::byte> frame, double bit_errors);
  void deliver_due(way to, std::int64_t now_ns);
  void transmit(way to, std::span<const std::byte> frame, std::int64_t now_ns);
  void hand_over(way to, std::span<const std::byte> frame, bool is_damaged);
  static bool later(const under_way& a, const under_way& b);

  runtime::random_source random_;
  receiver deliver_;
  std::array<one_way, 2> ways_;
};

} // namespace godwit::sim
