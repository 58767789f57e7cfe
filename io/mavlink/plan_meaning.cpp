#include "io/mavlink/plan_meaning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include <zlib.h>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame_meaning.hpp"
#include "io/mavlink/layout.hpp"

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

// Of the others vehicles keep neither coordinates nor altitude, whatever was sent.
bool has_place(std::uint16_t command) {
  constexpr mav_cmd none[] = {mav_cmd::nav_return_to_launch, mav_cmd::nav_guided_enable, mav_cmd::nav_delay};
  constexpr mav_cmd some[] = {mav_cmd::do_set_home, mav_cmd::do_return_path_start, mav_cmd::do_land_start,
                              mav_cmd::do_set_roi_location, mav_cmd::do_set_roi};
  const auto is_in = [&](const auto& list) {
    return std::ranges::any_of(list, [&](mav_cmd each) { return number(each) == command; });
  };
  const bool is_nav = command <= number(mav_cmd::nav_last);
  const bool is_of_fence = command >= number(mav_cmd::nav_fence_return_point);
  return is_in(some) || ((is_nav || is_of_fence) && !is_in(none));
}

bool is_at_the_same_place(const mission_item_int& a, const mission_item_int& b) {
  return !has_place(a.command) ||
         (is_near(a.x, b.x) && is_near(a.y, b.y) &&
          std::abs(known_part(a.z) - known_part(b.z)) <= altitude_tolerance_m && !differs_in_altitude_kind(a, b));
}

// PX4 keeps the one as the other.
bool is_same_command(std::uint16_t a, std::uint16_t b) {
  constexpr std::pair<mav_cmd, mav_cmd> kept_as[] = {{mav_cmd::nav_roi, mav_cmd::do_set_roi},
                                                     {mav_cmd::condition_delay, mav_cmd::nav_delay}};
  return a == b || std::ranges::any_of(
                       kept_as, [&](const auto& each) { return number(each.first) == a && number(each.second) == b; });
}

bool leads_the_same_way(const mission_item_int& a, const mission_item_int& b) {
  return a.command != number(mav_cmd::do_jump) || (a.param1 == b.param1 && a.param2 == b.param2);
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
  return is_same_command(a.command, b.command) && is_at_the_same_place(a, b) && leads_the_same_way(a, b) &&
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

std::uint32_t checksum_of(const std::vector<mission_item_int>& items) {
  auto crc = crc32(0, nullptr, 0);
  for (auto each : items) {
    each.target_system = 0;
    each.target_component = 0;
    each.mission_type = 0;
    each.current = 0;
    std::array<std::byte, layout<mission_item_int>::full_length> bytes;
    write_fields(each, bytes.data());
    crc = crc32(crc, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size()));
  }
  if (items.empty())
    return 0;
  return crc == 0 ? 1 : static_cast<std::uint32_t>(crc);
}

} // namespace godwit::io::mavlink
