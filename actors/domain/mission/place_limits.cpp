#include "actors/domain/mission/place_limits.hpp"

#include <utility>

#include "actors/domain/geo/distance_text.hpp"
#include "actors/domain/geo/geodesic.hpp"
#include "actors/domain/mission/commands/item_class.hpp"
#include "io/mavlink/frame_meaning.hpp"

namespace godwit::mission {

namespace {

using flight::vehicle_class;

std::string metres_text(double metres) { return geo::grouped(metres) + " m"; }

// Whoever has swapped the two numbers is told.
std::string swapped_sentence(const geo::point& at, const limits_origin& origin, const place_limits& limits) {
  const geo::point swapped{at.longitude_deg, at.latitude_deg};
  if (!geo::is_valid(swapped))
    return {};
  const auto away_m = geo::distance_m(origin.home, swapped);
  if (away_m > limits.max_distance_m)
    return {};
  return "; with latitude and longitude swapped it would be " + geo::distance_text(away_m) + " away";
}

std::string why_too_far(const std::string& what, const geo::point& at, const limits_origin& origin,
                        const place_limits& limits) {
  if (!geo::is_valid(at))
    return what + " is no place on earth.";
  const auto away_m = geo::distance_m(origin.home, at);
  if (away_m <= limits.max_distance_m)
    return {};
  return what + " is " + geo::distance_text(away_m) + ' ' +
         std::string(geo::direction_text(geo::bearing_deg(origin.home, at))) + " of home; at most " +
         geo::distance_text(limits.max_distance_m) + " are allowed (flight.max_distance_m)" +
         swapped_sentence(at, origin, limits) + '.';
}

std::string why_too_high(const std::string& what, double altitude_m, const limits_origin& origin,
                         const place_limits& limits) {
  const auto above_home_m = altitude_m - origin.home_altitude_m;
  if (origin.vehicle == vehicle_class::rover || above_home_m <= limits.max_altitude_m)
    return {};
  return what + " is " + metres_text(above_home_m) + " above home; at most " + metres_text(limits.max_altitude_m) +
         " are allowed (flight.max_altitude_m).";
}

// The first thing that is wrong with the places of an item; a visitor for each kind.
class item_judge {
public:
  item_judge(const document& mission, const limits_origin& origin, const place_limits& limits)
      : mission_(mission), origin_(origin), limits_(limits) {}

  [[nodiscard]] std::string judge(const std::string& what, const item& each) const {
    return std::visit([&](const auto& value) { return why(what, value); }, each);
  }

private:
  [[nodiscard]] std::string why(const std::string& what, const takeoff& each) const {
    return why_too_high(what, each.altitude_m, origin_, limits_);
  }
  [[nodiscard]] std::string why(const std::string& what, const waypoint& each) const {
    return why_out_of_limits(what, each.at, origin_, limits_);
  }
  [[nodiscard]] std::string why(const std::string& what, const loiter& each) const {
    return why_out_of_limits(what, each.at, origin_, limits_);
  }
  [[nodiscard]] std::string why(const std::string& what, const land& each) const {
    return why_out_of_limits(what, each.at, origin_, limits_);
  }
  [[nodiscard]] std::string why(const std::string&, const change_speed&) const { return {}; }
  [[nodiscard]] std::string why(const std::string&, const jump&) const { return {}; }
  [[nodiscard]] std::string why(const std::string& what, const command_item& each) const {
    if (!moves_vehicle(each))
      return {};
    const auto place = place_of(each);
    auto too_far = place ? why_too_far(what, {place->latitude, place->longitude}, origin_, limits_) : std::string();
    const auto height_m = height_above_home_m(each);
    return too_far.empty() && height_m ? why_too_high(what, *height_m + origin_.home_altitude_m, origin_, limits_)
                                       : too_far;
  }
  // Heights above the ground are taken for heights above home: the terrain is not known.
  [[nodiscard]] std::optional<double> height_above_home_m(const command_item& each) const {
    const auto kind = io::mavlink::altitude_in(each.frame);
    const auto& altitude = each.params.back();
    if (!kind || !altitude)
      return std::nullopt;
    if (kind != io::mavlink::altitude_kind::above_sea)
      return altitude;
    return origin_.home_above_sea_m ? std::optional(*altitude - *origin_.home_above_sea_m) : std::nullopt;
  }
  [[nodiscard]] std::string why(const std::string& what, const survey& each) const {
    for (const auto& corner : each.polygon)
      if (auto found = why_out_of_limits(what, {corner.latitude, corner.longitude, each.altitude_m}, origin_, limits_);
          !found.empty())
        return found;
    return {};
  }
  [[nodiscard]] std::string why(const std::string& what, const return_home& each) const {
    if (each.to || !mission_.return_point)
      return {};
    return why_out_of_limits(what + ", the return point,", *mission_.return_point, origin_, limits_);
  }

  const document& mission_;
  const limits_origin& origin_;
  const place_limits& limits_;
};

} // namespace

std::string why_out_of_limits(const std::string& what, const position& at, const limits_origin& origin,
                              const place_limits& limits) {
  auto too_far = why_too_far(what, {at.latitude, at.longitude}, origin, limits);
  return too_far.empty() ? why_too_high(what, at.altitude_m, origin, limits) : too_far;
}

std::vector<std::string> places_out_of_limits(const document& mission, std::size_t first, const limits_origin& origin,
                                              const place_limits& limits) {
  const item_judge judge(mission, origin, limits);
  std::vector<std::string> found;
  for (auto i = first; i < mission.items.size() && found.size() < max_places_out_of_limits; ++i) {
    const auto what = "Item " + std::to_string(i + 1) + " '" + id_of(mission.items[i]) + "'";
    if (auto why = judge.judge(what, mission.items[i]); !why.empty())
      found.push_back(std::move(why));
  }
  return found;
}

} // namespace godwit::mission
