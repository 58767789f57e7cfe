// What kind of vehicle it is, and its limits. Thread: values.
#pragma once

#include <cstdint>

namespace godwit::sim {

enum class craft_kind { rover, multirotor, fixed_wing };

struct craft {
  craft_kind kind = craft_kind::rover;
  double speed_mps = 2; // of its own choice
  double acceleration_mps2 = 1;
  double turn_rate_deg_s = 45;
  double climb_mps = 2.5;         // of what flies
  double descent_mps = 1.5;       // of what flies
  double min_speed_mps = 0;       // fixed wing
  double max_bank_deg = 0;        // fixed wing
  double loiter_radius_m = 0;     // fixed wing: of its circles, to the right
  double arrival_radius_m = 2;    // where an item has none of its own
  double takeoff_altitude_m = 10; // above home, where a take-off item has none
  double return_altitude_m = 15;  // above home
  double spool_up_s = 0;          // multirotor: told to climb it stands for so long, while its rotors get faster
  // Of a fixed wing that has rotors as well, a VTOL: it takes off, hovers and lands on those.
  bool has_rotors = false;
  double hover_speed_mps = 5;
  double hover_radius_m = 2;      // of arrival
  bool takes_off_to_place = true; // a take-off item leads to its place, too
  bool lands_on_return = false;   // on its rotors; else it circles over home
  // 50 steps a second: at 20 m/s less than half a metre each.
  static constexpr std::int64_t step_ns = 20'000'000;
};

[[nodiscard]] craft rover_craft();
[[nodiscard]] craft multirotor_craft();
[[nodiscard]] craft fixed_wing_craft();
[[nodiscard]] craft vtol_craft();

// How fast it goes: the craft's own speeds, or what a mission has changed them to.
struct pace {
  double speed_mps = 0;
  double climb_mps = 0;
  double descent_mps = 0;
};

[[nodiscard]] pace own_pace(const craft& of);

} // namespace godwit::sim
