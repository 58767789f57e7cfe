// Some legs, one after the other. Thread: one at a time.
#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "programs/godwit-sim/vehicle/flight/mover.hpp"
#include "programs/godwit-sim/vehicle/world/nearby.hpp"
#include "programs/godwit-sim/vehicle/world/position.hpp"

namespace godwit::sim {

// The parts of a manoeuvre. Thread: values.
struct climb_leg { // straight up or down, a fixed wing straight on; who stands on the ground takes off
  double altitude_m = 0;
};
struct go_leg { // done within the radius, and a multirotor at the altitude; a fixed wing also when it has passed it
  position to;
  double radius_m = 0;
  bool stops = false;
  double speed_mps = 0; // 0: what the pace says
  double circle_m = 0;  // of a fixed wing that stays there; negative: to the left; 0: its own
};
struct land_leg {};     // straight down to the ground; a fixed wing straight on
struct touch_down_leg { // fixed wing: down a straight path to this place on the ground
  position to;
};
struct change_leg { // a VTOL: to its rotors, or to its wings
  bool to_rotors = false;
};
struct wait_leg { // standing, at a hover or on circles
  double left_s = 0;
};
struct stay_leg {}; // the same, with no end

using leg = std::variant<climb_leg, go_leg, land_leg, touch_down_leg, change_leg, wait_leg, stay_leg>;
using leg_list = std::vector<leg>;

// Nobody flies lower than this above the ground but to land: an altitude of 0 is no landing.
constexpr double min_flight_height_m = 1;

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
