// The vehicle's body and the ground that it stands on: it moves as a rover or as a multirotor does, one small step at a
// time. Thread: one at a time.
#pragma once

#include "programs/godwit-sim/vehicle/flight/craft.hpp"
#include "programs/godwit-sim/vehicle/world/body.hpp"

namespace godwit::sim {

class mover {
public:
  // On the ground at WHERE, which is level and everywhere as high.
  mover(const craft& what, const position& where);

  void rest(double step_s); // no motors: who is in the air falls
  void hold(double step_s); // comes to a stop, and stays
  // To the place at the end of COURSE and the altitude; a multirotor is in the air. A rover's altitude stays.
  struct heading_for {
    course way;
    double altitude_m = 0;
    bool stops = false;
  };
  void go(const heading_for& place, const pace& how_fast, double step_s);
  void land(const pace& how_fast, double step_s);
  // Everything stops at once, on the ground.
  void drop();

  [[nodiscard]] const craft& what() const { return craft_; }
  [[nodiscard]] const body& where() const { return body_; }
  [[nodiscard]] double ground_m() const { return ground_m_; } // above mean sea level
  [[nodiscard]] bool is_multirotor() const { return craft_.kind == craft_kind::multirotor; }
  [[nodiscard]] bool is_in_air() const { return is_in_air_; }
  [[nodiscard]] bool is_still() const; // neither moves nor leans

private:
  void meet_ground();

  craft craft_;
  body body_;
  double ground_m_;
  bool is_in_air_ = false;
};

} // namespace godwit::sim
