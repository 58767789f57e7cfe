#include "programs/godwit-sim/vehicle/world/nearby.hpp"

#include <cmath>

#include "programs/godwit-sim/vehicle/world/angle.hpp"

namespace godwit::sim {

namespace {

// WGS84: half the axis at the equator, and the square of the eccentricity.
constexpr double equatorial_radius_m = 6'378'137.0;
constexpr double flattening = 1 / 298.257223563;
constexpr double eccentricity_squared = flattening * (2 - flattening);

// At most a tenth of a degree, 11 km, apart: the neglected terms grow with the cube of the distance.
constexpr double max_apart_deg = 0.1;
// Nearer to a pole the meridians converge too fast.
constexpr double max_latitude_deg = 80;

struct curvature {
  double meridian_m; // of a motion to the north, for each radian of latitude
  double parallel_m; // of a motion to the east, for each radian of longitude
  double sine_of_latitude;
};

curvature curvature_at(double latitude_deg) {
  const double sine = std::sin(latitude_deg * degree);
  const double cosine = std::sqrt(1 - sine * sine); // latitudes have no negative cosine
  const double w_squared = 1 - eccentricity_squared * sine * sine;
  const double normal_m = equatorial_radius_m / std::sqrt(w_squared);
  return {normal_m * (1 - eccentricity_squared) / w_squared, normal_m * cosine, sine};
}

} // namespace

bool is_nearby(const position& from, const position& to) {
  return std::abs(to.latitude_deg - from.latitude_deg) <= max_apart_deg &&
         std::abs(turn_of(to.longitude_deg - from.longitude_deg)) <= max_apart_deg &&
         std::abs(from.latitude_deg) <= max_latitude_deg;
}

course course_nearby(const position& from, const position& to) {
  const double north_rad = (to.latitude_deg - from.latitude_deg) * degree;
  const double east_rad = turn_of(to.longitude_deg - from.longitude_deg) * degree;
  const auto middle = curvature_at((from.latitude_deg + to.latitude_deg) / 2);
  const double north_m = north_rad * middle.meridian_m;
  const double east_m = east_rad * middle.parallel_m;
  if (north_m == 0 && east_m == 0)
    return {};
  // Half of the angle between the meridians of the two places: the bearing is wanted where the way begins.
  const double convergence_rad = east_rad * middle.sine_of_latitude / 2;
  return {heading_of((std::atan2(east_m, north_m) - convergence_rad) / degree), std::hypot(north_m, east_m)};
}

position stepped(const position& from, double north_m, double east_m) {
  if (std::abs(from.latitude_deg) > max_latitude_deg)
    return moved(from, {std::atan2(east_m, north_m) / degree, std::hypot(north_m, east_m)});
  const auto here = curvature_at(from.latitude_deg);
  const double longitude_deg = from.longitude_deg + east_m / here.parallel_m / degree;
  return {from.latitude_deg + north_m / here.meridian_m / degree, turn_of(longitude_deg), from.altitude_m};
}

namespace {

constexpr int answers_for_each_solution = 50; // a second at 50 steps
// Nearer than this, which happens close to a pole only, each step counts.
constexpr double min_distance_to_reuse_m = 5'000;

} // namespace

course way::from(const position& here) {
  if (is_nearby(here, to_))
    return course_nearby(here, to_);
  if (answers_left_ == 0) {
    exact_ = between(here, to_);
    answers_left_ = exact_.distance_m > min_distance_to_reuse_m ? answers_for_each_solution : 1;
  }
  --answers_left_;
  return exact_;
}

} // namespace godwit::sim
