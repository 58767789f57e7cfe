// A battery of four lithium cells in a row. It drains with time and load. Thread: one at a time.
#pragma once

#include <cstdint>

namespace godwit::sim {

class battery {
public:
  // ENDURANCE_S: how long a full one lasts at load 1.
  battery(double percent, double endurance_s);

  // LOAD: 1 is flight, idle_load what the electronics need at rest. Since the last call; the first only sets the clock.
  void advance(std::int64_t world_ns, double load);
  // As if another one had been put in.
  void set_percent(double percent);

  [[nodiscard]] double percent() const { return percent_; } // 0 to 100
  [[nodiscard]] double voltage_v() const;                   // of all cells, under the last load
  [[nodiscard]] double current_a() const;
  [[nodiscard]] double consumed_mah() const { return consumed_mah_; } // since the start
  static constexpr int cells = 4;
  static constexpr double capacity_mah = 5'000;
  static constexpr double idle_load = 0.02;

private:
  double percent_;
  double endurance_s_;
  double load_ = idle_load;
  double consumed_mah_ = 0;
  std::int64_t time_ns_ = -1;
};

} // namespace godwit::sim
