// Valid missions, made from a seed: each kind of item, fences, numbers with all their digits, ids with odd letters.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "messages/mission/document.hpp"

namespace godwit::mission {

class mission_maker {
public:
  explicit mission_maker(std::uint64_t seed) : random_(seed) {}

  document mission(std::size_t most_items = 12) {
    document result;
    result.mission_id = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";
    result.revision = whole(1, 2'000'000'000);
    result.return_point = place();
    if (whole(0, 1) == 0)
      result.planned_home = planned_home{number(-90, 90), number(-180, 180), maybe(-100, 3000)};
    const auto items = static_cast<std::size_t>(whole(1, static_cast<int>(most_items)));
    for (std::size_t i = 0; i < items; ++i)
      result.items.push_back(any_item("item-" + std::to_string(i + 1)));
    if (whole(0, 1) == 0) {
      result.items.push_back(any_command("item-" + std::to_string(items + 1)));
      result.items.push_back(jump{"item-" + std::to_string(items + 2), id_of(result.items.front()), whole(0, 5)});
      result.schema_version = schema_version_2;
      for (auto& each : result.items)
        if (auto* area = std::get_if<survey>(&each); area != nullptr && whole(0, 1) == 0)
          area->camera = camera();
    }
    for (int i = whole(0, 3); i > 0; --i)
      result.geofences.push_back(fence());
    return result;
  }

  survey_camera camera() {
    survey_camera result{{}, maybe(-90, 90), number(0, 100)};
    (whole(0, 2) == 0 ? result.trigger.interval_s : result.trigger.distance_m) = number(0.5, 50);
    return result;
  }

  item any_item(const std::string& id) {
    switch (whole(0, 6)) {
    case 0:
      return takeoff{id, number(0.1, 500)};
    case 1:
      return loiter{id, place(), number(-200, 200), number(0, 600)};
    case 2:
      return change_speed{id, number(0.1, 40)};
    case 3:
      return survey{id, polygon(), number(1, 120), number(1, 80), maybe(0, 359.9)};
    case 4:
      return land{id, place()};
    case 5:
      return return_home{id, whole(0, 1) == 0 ? std::optional(return_goal::home) : std::nullopt};
    default:
      return waypoint{id, place(), number(0, 60), number(0, 20), maybe(0.1, 40)};
    }
  }

  // Acts, waits and moves that godwit has no kind of its own for; single precision, as vehicles and lines keep it.
  item any_command(const std::string& id) {
    const auto single = [&](double least, double most) {
      return std::optional<double>(static_cast<float>(number(least, most)));
    };
    const auto degrees = [&](double most) { return std::optional(std::round(number(-most, most) * 1e7) / 1e7); };
    switch (whole(0, 3)) {
    case 0:
      return command_item{id, 206, 2, {single(0, 50), 0, 1, 0, 0, 0, 0}, true};
    case 1:
      return command_item{id, 112, 2, {single(0, 50), 0, 0, 0, 0, 0, 0}, true};
    case 2:
      return command_item{id, 31, 3, {1, single(-90, 90), 0, 1, degrees(89), degrees(179), single(1, 100)}, true};
    default:
      return command_item{id, 82, 0, {0, 0, 0, 0, degrees(89), degrees(179), single(1, 900)}, whole(0, 1) == 0};
    }
  }

  geofence fence() {
    geofence result{whole(0, 1) == 0 ? fence_kind::inclusion : fence_kind::exclusion, polygon(), {}, maybe(100, 200)};
    result.floor_m = maybe(-50, 50);
    return result;
  }

  // Seen from its middle, one corner comes after the other: so no edges cross.
  std::vector<vertex> polygon() {
    const vertex middle{number(-80, 80), number(-180, 180)};
    std::vector<vertex> corners;
    const int count = whole(3, 9);
    for (int i = 0; i < count; ++i) {
      const auto angle = (i + number(0, 0.5)) * 2 * std::numbers::pi / count;
      const auto radius = number(0.01, 0.02);
      corners.push_back({middle.latitude + radius * std::sin(angle),
                         std::remainder(middle.longitude + radius * std::cos(angle), 360)});
    }
    return corners;
  }

  position place() { return {number(-90, 90), number(-180, 180), number(-100, 3000)}; }

  double number(double least, double most) { return std::uniform_real_distribution<double>(least, most)(random_); }
  int whole(int least, int most) { return std::uniform_int_distribution<int>(least, most)(random_); }

private:
  std::optional<double> maybe(double least, double most) {
    return whole(0, 1) == 0 ? std::nullopt : std::optional(number(least, most));
  }

  std::mt19937_64 random_;
};

} // namespace godwit::mission
