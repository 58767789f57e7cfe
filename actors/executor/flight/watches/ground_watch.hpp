// Who acts on a vehicle that stands disarmed with a plan of ours: a flight that starts by itself waits for a person
// then.
//
// Seen from the moment in which the plan is brought until the start: a mode that godwit has not asked for, a command of
// somebody else that the vehicle obeys, one through a station, a home that is moved. What people do before, while the
// checks fail, keeps the start back for a while only (flight_start.hpp). In the start itself control_watch looks. Pure.
// Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>

#include "actors/executor/flight/flight_context.hpp"

namespace godwit::executor {

class ground_watch {
public:
  explicit ground_watch(flight_context& flight) : flight_(flight) {}

  // The vehicle has told its mode: by HEARTBEAT, or by CURRENT_MODE, which may be the last word of it before a start.
  void on_mode(effects& out, instant now);
  // Before and after each decision: what godwit does to its mode may be over before the vehicle tells it, and what is
  // shown then is what a later mode is compared with.
  void on_task();
  // Its home.
  void on_home(effects& out, instant now);
  // Somebody commands it, beside godwit or through a station.
  void on_act(effects& out);

private:
  [[nodiscard]] bool is_watched() const;
  [[nodiscard]] bool changes_mode() const; // godwit, now

  flight_context& flight_;
  std::optional<std::uint32_t> mode_; // in which it stands; none: it is not known, or godwit changes it
};

} // namespace godwit::executor
