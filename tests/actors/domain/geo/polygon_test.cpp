#include "actors/domain/geo/polygon.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "actors/domain/geo/geodesic.hpp"
#include "tests/actors/domain/geo/places.hpp"

namespace godwit::geo {
namespace polygon_test {

TEST(polygon, a_vertex_and_a_side_are_inside) {
  const polygon triangle({{0, 0}, {0, 0.01}, {0.01, 0}});
  EXPECT_TRUE(triangle.contains({0, 0}));
  EXPECT_TRUE(triangle.contains({0.01, 0}));
  EXPECT_TRUE(triangle.contains({0, 0.005}));
  EXPECT_FALSE(triangle.contains({-0.0001, 0.005}));
  EXPECT_FALSE(triangle.contains({0.006, 0.006}));
}

TEST(polygon, a_notch_is_outside) {
  const polygon arrow({{0, 0}, {0.01, 0.01}, {0, 0.004}, {-0.01, 0.01}});
  EXPECT_TRUE(arrow.contains({0, 0.002}));
  EXPECT_FALSE(arrow.contains({0, 0.006}));
}

TEST(polygon, the_antimeridian_runs_through_it) {
  const polygon field({{-0.01, 179.99}, {-0.01, -179.99}, {0.01, -179.99}, {0.01, 179.99}});
  EXPECT_TRUE(field.contains({0, 180}));
  EXPECT_TRUE(field.contains({0, -180}));
  EXPECT_TRUE(field.contains({0, -179.995}));
  EXPECT_FALSE(field.contains({0, -179.98}));
  EXPECT_FALSE(field.contains({0, 0}));
}

TEST(polygon, the_pole_lies_in_it) {
  const polygon cap({{89.99, 0}, {89.99, 90}, {89.99, 180}, {89.99, -90}});
  EXPECT_TRUE(cap.contains({90, 0}));
  EXPECT_TRUE(cap.contains({89.999, 33}));
  EXPECT_FALSE(cap.contains({89.98, 33}));
}

TEST(polygon, vertices_that_repeat_change_nothing) {
  const polygon twice({{0, 0}, {0, 0}, {0, 0.01}, {0.01, 0}, {0.01, 0}});
  EXPECT_TRUE(twice.contains({0.002, 0.002}));
  EXPECT_FALSE(twice.contains({0.009, 0.009}));
}

RC_GTEST_PROP(polygon_property, a_regular_polygon_holds_its_inner_circle_and_nothing_beyond_its_outer_one, ()) {
  const auto centre = *tests::anywhere();
  const double radius_m = *tests::number_between(10, 2000);
  const auto corners = *rc::gen::inRange(3, 12);
  std::vector<point> vertices;
  for (int i = 0; i < corners; ++i)
    vertices.push_back(destination(centre, 360.0 * i / corners, radius_m));
  const polygon area(vertices);
  const double bearing_deg = *tests::number_between(0, 360);
  const double inner_m = radius_m * std::cos(3.14159265358979 / corners);
  RC_ASSERT(area.contains(destination(centre, bearing_deg, 0.999 * inner_m)));
  const auto far = destination(centre, bearing_deg, 1.001 * radius_m);
  RC_ASSERT(!area.contains(far));
  RC_ASSERT(distance_m(area.centre(), destination(centre, bearing_deg, 0.999 * inner_m)) <= area.radius_m());
}

} // namespace polygon_test
} // namespace godwit::geo
