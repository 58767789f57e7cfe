#include "actors/executor/plan/survey/survey_lines.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "actors/domain/geo/flat_polygon.hpp"
#include "actors/domain/geo/geodesic.hpp"
#include "tests/actors/domain/geo/places.hpp"
#include "tests/actors/executor/plan/missions.hpp"

namespace godwit::executor::plan {
namespace survey_lines_test {

const auto survey_box = survey_of("box", tests::box(0, 0, 300, 100), 25);

double heading_of(const survey_line& line) {
  const auto to = geo::local_projection(line.from).to_local(line.to);
  return std::fmod(std::atan2(to.east_m, to.north_m) * 180 / std::numbers::pi + 360, 180);
}

TEST(survey_lines, have_the_heading_that_was_asked_for) {
  auto turned = survey_box;
  turned.heading_deg = 30;
  const auto lines = survey_lines(turned, tests::place(0, 0));
  for (const auto& each : *lines)
    EXPECT_NEAR(heading_of(each), 30, 0.05);
}

TEST(survey_lines, without_a_heading_they_run_the_long_way) {
  const auto lines = survey_lines(survey_box, tests::place(-100, -100));
  ASSERT_EQ(lines->size(), 4U);
  for (const auto& each : *lines)
    EXPECT_NEAR(heading_of(each), 90, 0.05);
  EXPECT_NEAR(geo::distance_m(lines->front().from, tests::place(0, 12.5)), 0, 0.01) << "where the vehicle comes from";
}

TEST(survey_lines, across_the_antimeridian_they_are_the_same) {
  const geo::point around{12, 179.9995};
  auto area = survey_box;
  area.polygon.clear();
  for (const auto& each : tests::box(0, 0, 300, 100))
    area.polygon.push_back(tests::corner(each.east_m, each.north_m, around));
  const auto lines = survey_lines(area, tests::place(-100, -100, around));
  ASSERT_EQ(lines->size(), 4U);
  for (const auto& each : *lines)
    EXPECT_NEAR(geo::distance_m(each.from, each.to), 300, 0.01);
}

TEST(survey_lines, what_can_not_be_laid_has_a_reason) {
  auto area = survey_of("large", tests::box(0, 0, 60'000, 100), 30);
  EXPECT_EQ(survey_lines(area, tests::middle).error(), plan_errc::area_too_large);
  area = survey_of("fine", tests::box(0, 0, 3000, 3000), 1);
  EXPECT_EQ(survey_lines(area, tests::middle).error(), plan_errc::too_many_lines);
  area = survey_of("dot", tests::box(0, 0, 0.02, 0.02), 1);
  EXPECT_EQ(survey_lines(area, tests::middle).error(), plan_errc::area_too_small);
}

struct laid_survey {
  mission::survey area;
  geo::flat_polygon ground;
  std::vector<geo::segment> lines;
  geo::segment longest; // of them: it tells the direction best

  // Metres to the left of the longest line.
  [[nodiscard]] double across_m(const geo::local_point& at) const {
    const auto way = longest.to - longest.from;
    return geo::cross(way, at - longest.from) / geo::length_m(way);
  }
};

// A polygon with dents somewhere on the globe, and its lines in the plane.
laid_survey any_survey() {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  const geo::point around{*tests::number_between(-85, 85), *tests::number_between(-180, 180)};
  mission::survey area{"any", {}, 50, *tests::number_between(5, 80), {}};
  for (const auto& each : tests::star(random, {0, 0}, 60, 600))
    area.polygon.push_back(tests::corner(each.east_m, each.north_m, around));
  if (random() % 2 == 0)
    area.heading_deg = *tests::number_between(0, 359);
  std::vector<geo::point> corners;
  for (const auto& each : area.polygon)
    corners.push_back({each.latitude, each.longitude});
  const geo::local_projection projection(corners.front());
  laid_survey result{area, geo::flat_polygon(corners, projection), {}, {}};
  const auto lines = survey_lines(area, tests::place(-500, 200, around));
  RC_ASSERT(lines.has_value());
  for (const auto& each : *lines) {
    const geo::segment line{projection.to_local(each.from), projection.to_local(each.to)};
    result.lines.push_back(line);
    if (geo::length_m(line.to - line.from) > geo::length_m(result.longest.to - result.longest.from))
      result.longest = line;
  }
  return result;
}

RC_GTEST_PROP(survey_lines_property, lines_stay_inside_the_polygon, ()) {
  const auto survey = any_survey();
  constexpr double tolerance_m = 0.01;
  for (const auto& each : survey.lines)
    for (int step = 0; step <= 50; ++step) {
      const auto at = geo::at_share(each, step / 50.0);
      RC_ASSERT(survey.ground.contains(at) || survey.ground.distance_to_sides_m(at) < tolerance_m);
    }
}

RC_GTEST_PROP(survey_lines_property, lines_are_parallel_and_apart_by_a_multiple_of_the_spacing, ()) {
  const auto survey = any_survey();
  for (const auto& each : survey.lines) {
    const double row_m = survey.across_m(each.from);
    RC_ASSERT(std::abs(row_m - survey.across_m(each.to)) < 0.02);
    RC_ASSERT(std::abs(std::remainder(row_m, survey.area.line_spacing_m)) < 0.02);
  }
}

RC_GTEST_PROP(survey_lines_property, each_point_of_the_polygon_is_half_a_spacing_from_a_line_or_its_row_at_most, ()) {
  const auto survey = any_survey();
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  std::uniform_real_distribution<double> anywhere(-1300, 1300);
  for (int i = 0; i < 300; ++i) {
    const double east_m = anywhere(random);
    const geo::local_point at{east_m, anywhere(random)};
    if (!survey.ground.contains(at))
      continue;
    double nearest_m = survey.area.line_spacing_m;
    for (const auto& each : survey.lines)
      nearest_m = std::min(nearest_m, std::abs(survey.across_m(each.from) - survey.across_m(at)));
    RC_ASSERT(nearest_m <= survey.area.line_spacing_m / 2 + 0.1);
  }
}

// Together with the one above: the whole polygon is covered.
RC_GTEST_PROP(survey_lines_property, each_point_of_a_row_that_lies_in_the_polygon_is_on_a_line, ()) {
  const auto survey = any_survey();
  const auto way = survey.longest.to - survey.longest.from;
  const auto left = (1 / geo::length_m(way)) * geo::local_point{-way.north_m, way.east_m};
  for (int row = -300; row <= 300; ++row)
    for (int step = -60; step <= 60; ++step) {
      const double along = step * 25 / geo::length_m(way);
      const auto at = geo::at_share(survey.longest, along) + (row * survey.area.line_spacing_m) * left;
      if (!survey.ground.contains(at) || survey.ground.distance_to_sides_m(at) < 0.2)
        continue;
      RC_ASSERT(std::any_of(survey.lines.begin(), survey.lines.end(),
                            [&](const geo::segment& each) { return geo::distance_m(at, each) < 0.1; }));
    }
}

RC_GTEST_PROP(survey_lines_property, the_same_survey_has_the_same_lines, ()) {
  const auto survey = any_survey();
  const auto from = tests::place(10, 20, {survey.area.polygon.front().latitude, survey.area.polygon.front().longitude});
  const auto once = survey_lines(survey.area, from);
  const auto again = survey_lines(survey.area, from);
  RC_ASSERT(once->size() == again->size());
  for (std::size_t i = 0; i < once->size(); ++i)
    RC_ASSERT((*once)[i].from.latitude_deg == (*again)[i].from.latitude_deg &&
              (*once)[i].to.longitude_deg == (*again)[i].to.longitude_deg);
}

} // namespace survey_lines_test
} // namespace godwit::executor::plan
