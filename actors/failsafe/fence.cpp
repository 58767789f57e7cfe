#include "actors/failsafe/fence.hpp"

#include <algorithm>
#include <cmath>

namespace godwit::failsafe {

namespace {

// A side is taken so much longer at both ends, so that no way slips through where two of them meet.
constexpr double side_slack_m = 0.01;

double cross(const geo::local_point& a, const geo::local_point& b) {
  return a.east_m * b.north_m - a.north_m * b.east_m;
}

double dot(const geo::local_point& a, const geo::local_point& b) { return a.east_m * b.east_m + a.north_m * b.north_m; }

geo::local_point minus(const geo::local_point& a, const geo::local_point& b) {
  return {a.east_m - b.east_m, a.north_m - b.north_m};
}

double length_m(const geo::local_point& a) { return std::hypot(a.east_m, a.north_m); }

void add_share(double share, std::vector<double>& shares) {
  if (share > 0 && share < 1)
    shares.push_back(share);
}

std::optional<std::string> fault_of(const mission::geofence& each) {
  if (each.vertices.size() < 3)
    return "has " + std::to_string(each.vertices.size()) + " corners; a fence has at least 3";
  if (each.vertices.size() > max_fence_corners)
    return "has " + std::to_string(each.vertices.size()) + " corners; at most " + std::to_string(max_fence_corners) +
           " are possible";
  for (const auto& corner : each.vertices)
    if (!geo::is_valid({corner.latitude, corner.longitude}))
      return "has a corner that is no place on earth";
  for (const auto height_m : {each.floor_m, each.ceiling_m})
    if (height_m && !std::isfinite(*height_m))
      return "has a floor or a ceiling that is not a number";
  if (each.floor_m && each.ceiling_m && *each.floor_m > *each.ceiling_m)
    return "has its floor above its ceiling";
  return std::nullopt;
}

} // namespace

tl::expected<fence, std::string> fence::build(const mission::geofence& from) {
  if (auto fault = fault_of(from))
    return tl::unexpected(std::move(*fault));
  std::vector<geo::point> corners;
  corners.reserve(from.vertices.size());
  for (const auto& each : from.vertices)
    corners.push_back({each.latitude, each.longitude});
  return fence(from, corners);
}

fence::fence(const mission::geofence& from, const std::vector<geo::point>& corners)
    : kind_(from.kind), floor_m_(from.floor_m), ceiling_m_(from.ceiling_m), area_(corners), picture_(corners.front()) {
  corners_.reserve(corners.size());
  for (const auto& each : corners)
    corners_.push_back(picture_.to_local(each));
}

bool fence::holds_height(double altitude_m, bool floor_counts) const {
  return (!floor_counts || !floor_m_ || altitude_m >= *floor_m_) && (!ceiling_m_ || altitude_m <= *ceiling_m_);
}

bool fence::contains(const place& there, bool floor_counts) const {
  return holds_height(there.altitude_m, floor_counts) && area_.contains(there.at);
}

fence::leg::leg(const fence& of, const place& from, const place& to)
    : fence_(&of), from_(from), to_(to), start_(of.picture_.to_local(from.at)),
      way_(minus(of.picture_.to_local(to.at), start_)) {}

// No point of the way can lie in the circle with the whole area in it.
bool fence::leg::is_far() const { return length_m(start_) - length_m(way_) > fence_->area_.radius_m() + side_slack_m; }

void fence::leg::add_side_cuts(const geo::local_point& p, const geo::local_point& q,
                               std::vector<double>& shares) const {
  const auto side = minus(q, p);
  const auto to_p = minus(p, start_);
  const auto turn = cross(way_, side);
  const auto lengths = length_m(way_) * length_m(side);
  if (lengths == 0)
    return;
  if (std::abs(turn) < 1e-9 * lengths) { // side by side: if they meet, then from one end of the side to the other
    if (std::abs(cross(to_p, way_)) > side_slack_m * length_m(way_))
      return;
    add_share(dot(to_p, way_) / dot(way_, way_), shares);
    add_share(dot(minus(q, start_), way_) / dot(way_, way_), shares);
    return;
  }
  const auto slack = side_slack_m / length_m(side);
  const auto along_side = cross(to_p, way_) / turn;
  if (along_side >= -slack && along_side <= 1 + slack)
    add_share(cross(to_p, side) / turn, shares);
}

void fence::leg::add_height_cut(std::optional<double> height_m, std::vector<double>& shares) const {
  if (height_m && from_.altitude_m != to_.altitude_m)
    add_share((*height_m - from_.altitude_m) / (to_.altitude_m - from_.altitude_m), shares);
}

void fence::leg::add_cuts(std::vector<double>& shares) const {
  if (is_far())
    return;
  add_height_cut(fence_->floor_m_, shares);
  add_height_cut(fence_->ceiling_m_, shares);
  const auto& corners = fence_->corners_;
  for (std::size_t i = 0; i < corners.size(); ++i)
    add_side_cuts(corners[i], corners[(i + 1) % corners.size()], shares);
}

bool fence::leg::is_inside(double share, bool floor_counts) const {
  if (share <= 0)
    return fence_->contains(from_, floor_counts);
  if (share >= 1)
    return fence_->contains(to_, floor_counts);
  if (is_far())
    return false;
  const auto altitude_m = from_.altitude_m + share * (to_.altitude_m - from_.altitude_m);
  const geo::local_point there{start_.east_m + share * way_.east_m, start_.north_m + share * way_.north_m};
  return fence_->holds_height(altitude_m, floor_counts) && fence_->area_.contains(fence_->picture_.to_globe(there));
}

} // namespace godwit::failsafe
