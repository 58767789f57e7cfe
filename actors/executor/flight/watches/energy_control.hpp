// Whether the battery lasts: for the way home in flight, and for the plan and the way home before it.
//
// The drain is measured in flight; before the first flight of this process it is the setting, where there is one. In
// flight people are warned once when what is left above the level at which the failsafe returns is just what the way
// home takes. Nothing is flown because of it. Pure. Thread: one at a time.
#pragma once

#include <optional>
#include <string>

#include "actors/domain/energy/energy.hpp"
#include "actors/executor/flight/flight_context.hpp"
#include "messages/executor/flight.hpp"

namespace godwit::executor {

class energy_control {
public:
  explicit energy_control(flight_context& flight) : flight_(flight) {}

  // The vehicle has told its battery's level.
  [[nodiscard]] effects on_battery(instant now);
  // Above the level of the failsafe's return, after PLAN and the way home from its end; none: not known.
  [[nodiscard]] std::optional<double> spare_after(const plan::flight_plan& plan) const;
  // What the way home would take now; for people.
  [[nodiscard]] way_home_estimate way_home(instant now) const;
  // In flight: people have been warned, and it has not got better.
  [[nodiscard]] bool is_short() const { return was_under_way_ && watch_.is_short(); }

private:
  [[nodiscard]] std::optional<double> drain() const;
  [[nodiscard]] std::optional<double> spare(const std::optional<double>& seconds) const;
  [[nodiscard]] std::optional<double> seconds_home(instant now) const;

  flight_context& flight_;
  energy::drain_meter meter_;
  energy::shortage_watch watch_;
  std::optional<double> measured_; // of this flight, or the last one
  bool was_under_way_ = false;
};

} // namespace godwit::executor
