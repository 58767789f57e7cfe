#include "programs/godwit-sim/camera/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "programs/godwit-sim/camera/random.hpp"

namespace godwit::sim::camera {

namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double relief_cell_m = 16;
constexpr double area_cell_m = 9;
constexpr double cloud_cell_m = 15;
constexpr point2 wind_m_s{4, 2};
constexpr double area_contrast = 14;
constexpr double glint_rate_hz = 20; // a glint is there or not for a twentieth of a second
constexpr double share_of_pause = 0.25;

// What each use of the seed is for; a new one is added at the end, so that scenes stay as they are.
enum class use : std::uint64_t { ground, relief, areas, clouds, sun, cells };

std::uint64_t seed_of(std::uint64_t seed, use what) { return seed_for(seed, static_cast<std::uint64_t>(what)); }

std::uint64_t seed_of_cell(std::uint64_t seed, int row, int column) {
  const auto place =
      (static_cast<std::uint64_t>(static_cast<std::uint32_t>(row)) << 32U) | static_cast<std::uint32_t>(column);
  return seed_for(seed_of(seed, use::cells), place);
}

// 2.3 of a thing: two, and in three cells of ten a third one.
int drawn_count(double mean, random_source& random) { return static_cast<int>(mean + random.uniform()); }

// The part of the time in which it moves, up to TIME_S.
double moving_time(const mover& who, double time_s) {
  if (who.pause_every_s <= 0)
    return time_s;
  const double rounds = std::floor(time_s / who.pause_every_s);
  const double into = time_s - rounds * who.pause_every_s;
  const double moving = who.pause_every_s * (1 - share_of_pause);
  return rounds * moving + std::min(into, moving);
}

} // namespace

scene_settings tier_a(std::uint64_t seed) {
  scene_settings made;
  made.seed = seed;
  return made;
}

scene_settings tier_b(std::uint64_t seed) {
  scene_settings made = tier_a(seed);
  made.relief_m = 1.2;
  made.buildings_a_cell = 0.5;
  made.trees_a_cell = 4;
  made.glints_a_cell = 3;
  made.has_shadows = true;
  made.has_clouds = true;
  return made;
}

mover_place place_of(const mover& who, double time_s) {
  const double t = moving_time(who, time_s);
  const double turned_by = who.turn_rad_s * t;
  const double middle = who.heading_rad + turned_by / 2;
  // The chord of the arc.
  const double shrink = std::abs(turned_by) < 1e-9 ? 1 : std::sin(turned_by / 2) / (turned_by / 2);
  const double chord = who.speed_m_s * t * shrink;
  const bool moves = moving_time(who, time_s + 1e-3) > t;
  return {{who.start.x + chord * std::cos(middle), who.start.y + chord * std::sin(middle)},
          who.heading_rad + turned_by,
          moves ? who.speed_m_s : 0};
}

scene::scene(scene_settings settings)
    : settings_(std::move(settings)), ground_(seed_of(settings_.seed, use::ground), settings_.style),
      relief_(seed_of(settings_.seed, use::relief), relief_cell_m),
      areas_(seed_of(settings_.seed, use::areas), area_cell_m),
      clouds_(seed_of(settings_.seed, use::clouds), cloud_cell_m) {
  random_source random(seed_of(settings_.seed, use::sun));
  const double azimuth = random.between(0, two_pi);
  const double length = 1 / std::tan(random.between(0.5, 1.2)); // the sun stands 30 to 70 degrees high
  shadow_ = {length * std::cos(azimuth), length * std::sin(azimuth)};
}

double scene::ground_z(double north_m, double east_m) const {
  return settings_.relief_m == 0 ? 0 : -settings_.relief_m * relief_.at(north_m, east_m);
}

double scene::sunlight(double north_m, double east_m, double time_s) const {
  if (!settings_.has_clouds)
    return 1;
  const double cloud = clouds_.at(north_m - wind_m_s.x * time_s, east_m - wind_m_s.y * time_s);
  return 1 - 0.12 * std::clamp(cloud + 1, 0.0, 2.0);
}

shapes scene::around(const point2& middle, double reach_m, double time_s) const {
  shapes found;
  const int reach =
      std::clamp(static_cast<int>(reach_m / cell_m) + 1, 1, (static_cast<int>(std::sqrt(max_cells)) - 1) / 2);
  const int row = static_cast<int>(std::floor(middle.x / cell_m));
  const int column = static_cast<int>(std::floor(middle.y / cell_m));
  const bool is_bare = settings_.buildings_a_cell == 0 && settings_.trees_a_cell == 0 && settings_.glints_a_cell == 0;
  for (int dr = -reach; dr <= reach && !is_bare; ++dr)
    for (int dc = -reach; dc <= reach; ++dc)
      add_cell(found, row + dr, column + dc, time_s);
  std::uint32_t number = 0;
  for (const auto& each : settings_.movers) {
    ++number;
    const auto where = place_of(each, time_s);
    found.boxes.push_back({where.at, ground_z(where.at.x, where.at.y), where.heading_rad, each.length_m, each.width_m,
                           each.height_m, each.brightness, static_cast<std::uint32_t>(scrambled(each.id)), number});
  }
  return found;
}

void scene::add_cell(shapes& to, int row, int column, double time_s) const {
  random_source random(seed_of_cell(settings_.seed, row, column));
  const auto place = [&] { return point2{(row + random.uniform()) * cell_m, (column + random.uniform()) * cell_m}; };
  for (int n = drawn_count(settings_.buildings_a_cell, random); n > 0; --n) {
    box_shape house;
    house.centre = place();
    house.base_z = ground_z(house.centre.x, house.centre.y);
    house.heading_rad = random.between(0, two_pi);
    house.length_m = random.between(4, 14);
    house.width_m = random.between(3, 9);
    house.height_m = random.between(2.5, 7);
    house.brightness = static_cast<int>(random.between(60, 210));
    house.pattern = static_cast<std::uint32_t>(random.next());
    to.boxes.push_back(house);
  }
  for (int n = drawn_count(settings_.trees_a_cell, random); n > 0; --n) {
    crown_shape crown;
    const point2 at = place();
    crown.base_z = ground_z(at.x, at.y);
    const double height = random.between(2, 8);
    const double sway = random.between(0.02, 0.35) * height / 8;
    const double phase = random.between(0, two_pi);
    const double speed = two_pi * random.between(0.3, 1.0);
    crown.centre = {at.x + sway * std::sin(speed * time_s + phase),
                    at.y + sway * std::cos(0.8 * speed * time_s + phase), crown.base_z - height};
    crown.radius_m = random.between(0.8, 2.8);
    crown.brightness = static_cast<int>(random.between(45, 110));
    crown.pattern = static_cast<std::uint32_t>(random.next());
    to.crowns.push_back(crown);
  }
  const auto moment = static_cast<std::uint64_t>(std::floor(time_s * glint_rate_hz) + 1e6);
  for (int n = drawn_count(settings_.glints_a_cell, random); n > 0; --n) {
    const point2 at = place();
    const double radius = random.between(0.6, 2.2);
    const std::uint64_t lot = seed_for(random.next(), moment);
    if (lot % 16 == 0)
      to.glints.push_back({{at.x, at.y, ground_z(at.x, at.y)}, radius});
  }
}

} // namespace godwit::sim::camera
