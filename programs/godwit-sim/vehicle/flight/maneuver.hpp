// Some legs, one after the other. Thread: one at a time.
#pragma once

#include <cstddef>

#include "programs/godwit-sim/vehicle/flight/leg.hpp"
#include "programs/godwit-sim/vehicle/flight/mover.hpp"
#include "programs/godwit-sim/vehicle/world/way.hpp"

namespace godwit::sim {

class maneuver {
public:
  // Without legs: done.
  void begin(leg_list legs);

  // When there is nothing left to do, it stays where it is.
  void step(mover& vehicle, const pace& how_fast, double step_s);
  [[nodiscard]] bool is_done() const { return index_ == legs_.size(); }
  // Only time that nobody waits for is left: done, or it stays.
  [[nodiscard]] bool is_settled() const;

private:
  // Whether it is done.
  bool go(const go_leg& how, mover& vehicle, const pace& how_fast, double step_s);
  bool climb(const climb_leg& how, mover& vehicle, const pace& how_fast, double step_s);
  bool touch_down(mover& vehicle, const pace& how_fast, double step_s);
  [[nodiscard]] bool has_passed(const course& rest) const;
  void keep(mover& vehicle, const pace& how_fast, double step_s);
  void enter_leg(const mover& vehicle);
  void set_station(const position& where, const mover& vehicle, double circle_m = 0);

  leg_list legs_;
  std::size_t index_ = 0;
  bool is_begun_ = false; // the leg at index_
  // Where the last leg led: a multirotor goes on to it while it waits there, and after the manoeuvre; a fixed wing
  // circles around it.
  bool has_station_ = false;
  way station_{{}};
  double circle_m_ = 0;
  course begun_; // the way to the station where its leg began
  double slope_ = 0;
};

} // namespace godwit::sim
