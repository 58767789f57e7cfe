#include "programs/godwit-sim/missions/synthetic_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>

#include "actors/domain/mission/utc_text.hpp"

namespace godwit::sim::missions {
namespace {

constexpr std::array class_groups{"vehicle", "building", "boat", "animal", "tree", "pylon"};
constexpr double metres_in_degree = 111'320;        // of latitude
constexpr std::int64_t first_day_s = 1'767'225'600; // 2026-01-01
constexpr std::int64_t days_s = 100 * 86'400;
constexpr std::int64_t second_ns = 1'000'000'000;

// std's distributions differ from library to library; this one does not.
double share(std::mt19937_64& random) { return static_cast<double>(random() >> 11U) * 0x1.0p-53; }

// As many decimals as an object needs: 0.1 m on the ground.
double rounded(double value, double steps) { return std::round(value * steps) / steps; }

std::string uuid(std::mt19937_64& random) {
  const auto high = random();
  const auto low = random();
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%08x-%04x-4%03x-%04x-%012llx", static_cast<unsigned>(high >> 32U),
                static_cast<unsigned>(high >> 16U) & 0xFFFFU, static_cast<unsigned>(high) & 0xFFFU,
                (static_cast<unsigned>(low >> 48U) & 0x3FFFU) | 0x8000U,
                static_cast<unsigned long long>(low & 0xFFFFFFFFFFFFULL));
  return text.data();
}

} // namespace

std::vector<mission::map_object> synthetic_map(const map_request& wanted, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<mission::map_object> all;
  const double height_deg = synthetic_square_m / metres_in_degree;
  const double width_deg = height_deg / std::max(0.01, std::cos(wanted.latitude * std::numbers::pi / 180));
  for (std::size_t i = 0; i < wanted.count; ++i) {
    mission::map_object each;
    each.object_id = uuid(random);
    each.class_group = class_groups.at(random() % class_groups.size());
    each.latitude = std::clamp(rounded(wanted.latitude + (share(random) - 0.5) * height_deg, 1e6), -90.0, 90.0);
    each.longitude = std::clamp(rounded(wanted.longitude + (share(random) - 0.5) * width_deg, 1e6), -180.0, 180.0);
    each.altitude_m = rounded(400 + 100 * share(random), 10);
    each.confidence = rounded(0.5 + 0.5 * share(random), 100);
    const auto seen_s = first_day_s + static_cast<std::int64_t>(random() % days_s);
    each.first_seen = mission::utc_text(seen_s * second_ns);
    each.last_seen = mission::utc_text((seen_s + static_cast<std::int64_t>(random() % days_s)) * second_ns);
    all.push_back(std::move(each));
  }
  return all;
}

} // namespace godwit::sim::missions
