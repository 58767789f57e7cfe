#include "programs/godwit-sim/vehicle/world/battery.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace godwit::sim {
namespace {

constexpr double min_endurance_s = 1;
// Of the whole battery: what it loses at load 1.
constexpr double sag_v = 0.6;

struct cell_state {
  double percent;
  double volt;
};

// Of one cell at rest: steep at both ends, flat between.
constexpr cell_state discharge_curve[] = {{0, 3.3}, {10, 3.6}, {25, 3.72}, {50, 3.82}, {75, 3.98}, {100, 4.2}};

double cell_volt(double percent) {
  const auto* above = std::begin(discharge_curve) + 1;
  while (above->percent < percent && above + 1 != std::end(discharge_curve))
    ++above;
  const auto& below = *(above - 1);
  return std::lerp(below.volt, above->volt, (percent - below.percent) / (above->percent - below.percent));
}

double bounded(double percent) { return percent > 0 ? std::min(percent, 100.0) : 0; }

} // namespace

battery::battery(double percent, double endurance_s)
    : percent_(bounded(percent)), endurance_s_(std::max(endurance_s, min_endurance_s)) {}

void battery::advance(std::int64_t world_ns, double load) {
  if (time_ns_ >= 0 && world_ns > time_ns_) {
    const double used_percent = static_cast<double>(world_ns - time_ns_) * 1e-9 * load * 100 / endurance_s_;
    const double taken_percent = std::min(used_percent, percent_);
    percent_ -= taken_percent;
    consumed_mah_ += taken_percent / 100 * capacity_mah;
  }
  time_ns_ = std::max(time_ns_, world_ns);
  load_ = load;
}

void battery::set_percent(double percent) { percent_ = bounded(percent); }

double battery::voltage_v() const { return cells * cell_volt(percent_) - sag_v * load_; }

double battery::current_a() const { return load_ * capacity_mah * 3.6 / endurance_s_; }

} // namespace godwit::sim
