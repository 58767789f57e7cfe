#include "io/mavlink/plan_meaning.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame_meaning.hpp"

namespace godwit::io::mavlink {

namespace {

bool is_near(std::int32_t a, std::int32_t b) {
  return std::abs(std::int64_t{a} - std::int64_t{b}) <= position_tolerance;
}

// Not a number means "as it is", and comes back as 0 where the vehicle can not keep it.
float known_part(float value) { return std::isnan(value) ? 0.0F : value; }

// The frame of an item without a position says nothing, and vehicles change it.
bool differs_in_altitude_kind(const mission_item_int& a, const mission_item_int& b) {
  const auto ours = altitude_in(a.frame);
  const auto theirs = altitude_in(b.frame);
  const bool has_position = a.x != 0 || a.y != 0;
  return has_position && ours && theirs && ours != theirs;
}

bool is_same_speed(const mission_item_int& a, const mission_item_int& b) {
  return a.command != number(mav_cmd::do_change_speed) ||
         std::abs(known_part(a.param2) - known_part(b.param2)) <= speed_tolerance_mps;
}

// At a place, or on a circle around it.
bool stays_as_long(const mission_item_int& a, const mission_item_int& b) {
  const bool has_time = a.command == number(mav_cmd::nav_waypoint) || a.command == number(mav_cmd::nav_loiter_time) ||
                        a.command == number(mav_cmd::nav_delay);
  const auto ours = known_part(a.param1);
  const auto theirs = known_part(b.param1);
  return !has_time || ours == 0 || theirs == 0 || std::abs(ours - theirs) < time_tolerance_s;
}

} // namespace

bool means_the_same(const mission_item_int& a, const mission_item_int& b) {
  return a.command == b.command && is_near(a.x, b.x) && is_near(a.y, b.y) &&
         std::abs(known_part(a.z) - known_part(b.z)) <= altitude_tolerance_m && !differs_in_altitude_kind(a, b) &&
         is_same_speed(a, b) && stays_as_long(a, b);
}

std::optional<std::size_t> first_difference(std::span<const mission_item_int> ours,
                                            std::span<const mission_item_int> theirs, bool first_is_home) {
  const auto shorter = std::min(ours.size(), theirs.size());
  for (std::size_t i = first_is_home ? 1 : 0; i < shorter; ++i)
    if (!means_the_same(ours[i], theirs[i]))
      return i;
  if (ours.size() != theirs.size())
    return shorter;
  return std::nullopt;
}

} // namespace godwit::io::mavlink
