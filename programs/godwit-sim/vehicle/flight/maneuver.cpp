#include "programs/godwit-sim/vehicle/flight/maneuver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "programs/godwit-sim/vehicle/world/angle.hpp"

namespace godwit::sim {

namespace {

// A multirotor within this of an altitude is there.
constexpr double at_altitude_m = 0.5;
// A fixed wing comes to its altitude slowly.
constexpr double wing_at_altitude_m = 2;
// Nobody drives or flies more precisely than this.
constexpr double min_radius_m = 0.3;

template <class... Fs>
struct each_of : Fs... {
  using Fs::operator()...;
};
template <class... Fs>
each_of(Fs...) -> each_of<Fs...>;

bool is_at_altitude(const mover& vehicle, double altitude_m) {
  return !vehicle.is_multirotor() || std::abs(vehicle.where().where.altitude_m - altitude_m) <= at_altitude_m;
}

double height_m(const mover& vehicle) { return vehicle.where().where.altitude_m - vehicle.ground_m(); }

} // namespace

void maneuver::begin(leg_list legs) {
  legs_ = std::move(legs);
  index_ = 0;
  is_begun_ = false;
  has_station_ = false;
}

void maneuver::set_station(const position& where, const mover& vehicle, double circle_m) {
  station_ = way(where);
  has_station_ = true;
  circle_m_ = circle_m;
  begun_ = station_.from(vehicle.where().where);
}

void maneuver::enter_leg(const mover& vehicle) {
  if (std::exchange(is_begun_, true))
    return;
  std::visit(each_of{[&](const climb_leg& how) {
                       auto above = vehicle.where().where;
                       above.altitude_m = how.altitude_m;
                       set_station(above, vehicle);
                       has_station_ = !vehicle.is_fixed_wing(); // it will be elsewhere
                     },
                     [&](const go_leg& how) { set_station(how.to, vehicle, how.circle_m); },
                     [&](const land_leg&) { has_station_ = false; },
                     [&](const touch_down_leg& how) {
                       set_station(how.to, vehicle);
                       slope_ = begun_.distance_m > 0 ? height_m(vehicle) / begun_.distance_m : 0;
                     },
                     [](const auto&) {}},
             legs_[index_]);
}

void maneuver::step(mover& vehicle, const pace& how_fast, double step_s) {
  if (is_done())
    return keep(vehicle, how_fast, step_s);
  enter_leg(vehicle);
  const bool done =
      std::visit(each_of{[&](const climb_leg& how) { return climb(how, vehicle, how_fast, step_s); },
                         [&](const go_leg& how) { return go(how, vehicle, how_fast, step_s); },
                         [&](const land_leg&) {
                           vehicle.land(how_fast, step_s);
                           return !vehicle.is_in_air();
                         },
                         [&](const touch_down_leg&) { return touch_down(vehicle, how_fast, step_s); },
                         [&](const change_leg& how) { return vehicle.change_to(how.to_rotors, how_fast, step_s); },
                         [&](wait_leg& how) {
                           keep(vehicle, how_fast, step_s);
                           how.left_s -= step_s;
                           return how.left_s <= 0;
                         },
                         [&](const stay_leg&) {
                           keep(vehicle, how_fast, step_s);
                           return false;
                         }},
                 legs_[index_]);
  if (!done)
    return;
  ++index_;
  is_begun_ = false;
}

bool maneuver::is_settled() const { return is_done() || std::holds_alternative<stay_leg>(legs_[index_]); }

void maneuver::keep(mover& vehicle, const pace& how_fast, double step_s) {
  // A rover that has come too far does not turn round for it.
  if (!has_station_ || vehicle.is_rover())
    return vehicle.hold(step_s);
  const mover::heading_for place{station_.from(vehicle.where().where), station_.to().altitude_m, true};
  if (vehicle.is_fixed_wing())
    return vehicle.circle(place, circle_m_, how_fast, step_s);
  vehicle.go(place, how_fast, step_s);
}

bool maneuver::climb(const climb_leg& how, mover& vehicle, const pace& how_fast, double step_s) {
  if (!vehicle.is_fixed_wing()) {
    keep(vehicle, how_fast, step_s);
    return is_at_altitude(vehicle, how.altitude_m);
  }
  vehicle.climb_ahead(how.altitude_m, how_fast, step_s);
  return vehicle.is_in_air() && std::abs(vehicle.where().where.altitude_m - how.altitude_m) <= wing_at_altitude_m;
}

bool maneuver::touch_down(mover& vehicle, const pace& how_fast, double step_s) {
  const auto rest = station_.from(vehicle.where().where);
  if (vehicle.is_low() || has_passed(rest))
    vehicle.land(how_fast, step_s);
  else
    vehicle.approach(rest, slope_, how_fast, step_s);
  has_station_ = false; // it stays where it has come to
  return !vehicle.is_in_air();
}

// The place lies behind it, seen along the way on which it came.
bool maneuver::has_passed(const course& rest) const {
  return std::abs(turn_of(rest.bearing_deg - begun_.bearing_deg)) > 90;
}

bool maneuver::go(const go_leg& how, mover& vehicle, const pace& how_fast, double step_s) {
  pace own = how_fast;
  if (how.speed_mps > 0)
    own.speed_mps = how.speed_mps;
  vehicle.go({station_.from(vehicle.where().where), how.to.altitude_m, how.stops}, own, step_s);
  // Fast as it is, it may step over a small circle.
  const double radius_m = std::max({how.radius_m, min_radius_m, vehicle.where().ground_speed_mps * step_s});
  const auto rest = station_.from(vehicle.where().where);
  if (vehicle.is_fixed_wing())
    return vehicle.is_in_air() && (rest.distance_m <= radius_m || has_passed(rest));
  return rest.distance_m <= radius_m && is_at_altitude(vehicle, how.to.altitude_m);
}

} // namespace godwit::sim
