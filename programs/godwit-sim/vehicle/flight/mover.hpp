// The vehicle's body and the ground that it stands on: it moves as a rover, a multirotor or a fixed wing does, one
// small step at a time. Thread: one at a time.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "programs/godwit-sim/vehicle/flight/craft.hpp"
#include "programs/godwit-sim/vehicle/world/body.hpp"
#include "programs/godwit-sim/vehicle/world/motions.hpp"
#include "programs/godwit-sim/vehicle/world/nearby.hpp"

namespace godwit::sim {

class mover {
public:
  // On the ground at WHERE, which is level and everywhere as high.
  mover(const craft& what, const position& where);

  void rest(double step_s); // no motors: who is in the air falls, or glides
  void hold(double step_s); // comes to a stop, and stays; a fixed wing in the air circles around where that began
  // To the place at the end of COURSE and the altitude; a multirotor is in the air. A rover's altitude stays. A fixed
  // wing on the ground stays there.
  struct heading_for {
    course way;
    double altitude_m = 0;
    bool stops = false;
  };
  void go(const heading_for& place, const pace& how_fast, double step_s);
  // A fixed wing in the air: around the place. RADIUS_M: negative: to the left; 0: its own.
  void circle(const heading_for& centre, double radius_m, const pace& how_fast, double step_s);
  // A fixed wing: from the ground or in the air, straight on to the altitude.
  void climb_ahead(double altitude_m, const pace& how_fast, double step_s);
  // A fixed wing in the air: to the place at the end of COURSE, on a straight path to the ground of this slope.
  void approach(const course& way, double slope, const pace& how_fast, double step_s);
  void land(const pace& how_fast, double step_s);
  // A VTOL: on to its wings (then it speeds up straight on) or to its rotors (then it slows down). True: it is done.
  [[nodiscard]] bool change_to(bool rotors, const pace& how_fast, double step_s);
  // Everything stops at once, on the ground.
  void drop();
  // Something holds it where it is, whatever its motors do; not a fixed wing in the air.
  void block(bool is_blocked) { is_blocked_ = is_blocked; }
  // On the ground; it returns to the nearest of them and of home.
  void set_rally_points(std::vector<position> places) { rally_points_ = std::move(places); }
  [[nodiscard]] position return_place(const position& home) const;

  [[nodiscard]] const craft& what() const { return craft_; }
  [[nodiscard]] const body& where() const { return body_; }
  [[nodiscard]] double ground_m() const { return ground_m_; } // above mean sea level
  [[nodiscard]] bool is_rover() const { return craft_.kind == craft_kind::rover; }
  [[nodiscard]] bool is_vtol() const { return craft_.has_rotors; }
  // As it flies now.
  [[nodiscard]] bool is_multirotor() const { return craft_.kind == craft_kind::multirotor || is_on_rotors_; }
  [[nodiscard]] bool is_fixed_wing() const { return craft_.kind == craft_kind::fixed_wing && !is_on_rotors_; }
  // MAV_VTOL_STATE: 0 no VTOL, 1 and 2 on the way to its wings and to its rotors, 3 on its rotors, 4 on its wings.
  [[nodiscard]] std::uint8_t vtol_state() const;
  [[nodiscard]] bool is_in_air() const { return is_in_air_; }
  [[nodiscard]] bool is_still() const; // neither moves nor leans
  // A fixed wing is as low as where it holds off before it touches the ground.
  [[nodiscard]] bool is_low() const;

private:
  void meet_ground();
  void fly_wing(const circle_course& where_to, double altitude_m, const pace& how_fast, double step_s);

  craft craft_;
  body body_;
  double ground_m_;
  bool is_in_air_ = false;
  bool is_blocked_ = false;
  std::vector<position> rally_points_;
  bool is_on_rotors_;
  bool is_changing_ = false; // to its wings on its rotors, or just from its wings
  bool was_on_wings_ = false;
  double spun_up_s_ = 0;       // since its motors run, while it was told to climb
  std::optional<way> circled_; // by a fixed wing that holds
};

} // namespace godwit::sim
