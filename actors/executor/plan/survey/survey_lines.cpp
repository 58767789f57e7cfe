#include "actors/executor/plan/survey/survey_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "actors/domain/geo/local_projection.hpp"
#include "actors/executor/plan/places.hpp"
#include "actors/executor/plan/survey/best_heading.hpp"
#include "actors/executor/plan/survey/line_order.hpp"
#include "actors/executor/plan/survey/scan_lines.hpp"

namespace godwit::executor::plan {

namespace {

using geo::local_point;

// Between axes to the east and north, and those along and across lines of some heading.
class line_axes {
public:
  explicit line_axes(double heading_deg)
      : east_(std::sin(heading_deg * std::numbers::pi / 180)), north_(std::cos(heading_deg * std::numbers::pi / 180)) {}

  [[nodiscard]] line_point turned(const local_point& at) const {
    return {at.east_m * east_ + at.north_m * north_, at.east_m * north_ - at.north_m * east_};
  }
  [[nodiscard]] local_point turned_back(const line_point& at) const {
    return {at.along_m * east_ + at.across_m * north_, at.along_m * north_ - at.across_m * east_};
  }

private:
  double east_;
  double north_;
};

} // namespace

tl::expected<std::vector<survey_line>, plan_errc> survey_lines(const mission::survey& area,
                                                               const geo::point& coming_from) {
  const geo::local_projection projection(point_of(area.polygon.front()));
  std::vector<local_point> corners;
  for (const auto& each : area.polygon) {
    corners.push_back(projection.to_local(point_of(each)));
    if (std::hypot(corners.back().east_m, corners.back().north_m) > max_survey_radius_m)
      return tl::unexpected(plan_errc::area_too_large);
  }
  const line_axes axes(area.heading_deg ? *area.heading_deg : best_heading_deg(corners));
  std::vector<line_point> turned;
  for (const auto& each : corners)
    turned.push_back(axes.turned(each));
  const auto rows = scan_rows(turned, area.line_spacing_m, max_survey_lines);
  if (!rows)
    return tl::unexpected(plan_errc::too_many_lines);
  const auto to_globe = [&](const line_point& at) { return projection.to_globe(axes.turned_back(at)); };
  std::vector<survey_line> lines;
  for (const auto& each : lines_in_order(*rows, axes.turned(projection.to_local(coming_from))))
    lines.push_back({to_globe(each.from), to_globe(each.to)});
  if (lines.empty())
    return tl::unexpected(plan_errc::area_too_small);
  return lines;
}

} // namespace godwit::executor::plan
