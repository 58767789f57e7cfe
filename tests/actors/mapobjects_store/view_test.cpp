#include "actors/mapobjects_store/view.hpp"

#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {
namespace view_test {

using namespace godwit::tests;

geo::point at(double east_m, double north_m) {
  const auto there = place(east_m, north_m);
  return {there.latitude_deg, there.longitude_deg};
}

bool is_in(const std::vector<geo::bounding_box>& boxes, const geo::point& where) {
  for (const auto& box : boxes)
    if (where.latitude_deg >= box.south_deg && where.latitude_deg <= box.north_deg &&
        where.longitude_deg >= box.west_deg && where.longitude_deg <= box.east_deg)
      return true;
  return false;
}

TEST(view, each_circle_and_polygon_is_an_area) {
  pass_end pass;
  pass.circles = {{place(0), 10}, {place(100), 20}};
  pass.polygons = {{{place(0), place(10), place(10, 10)}}};
  EXPECT_EQ(areas_of(pass).size(), 3U);
}

TEST(view, a_circle_contains_its_rim_and_nothing_beyond) {
  const view_area area = circle_area{at(0, 0), 50};
  EXPECT_TRUE(contains(area, at(49.9, 0)));
  EXPECT_FALSE(contains(area, at(50.1, 0)));
  EXPECT_FALSE(contains(area, at(36, 36)));
}

TEST(view, a_polygon_contains_what_lies_between_its_edges) {
  pass_end pass;
  pass.polygons = {{{place(0), place(100), place(0, 100)}}};
  const auto areas = areas_of(pass);
  EXPECT_TRUE(contains(areas[0], at(40, 40)));
  EXPECT_FALSE(contains(areas[0], at(60, 60)));
}

TEST(view, all_that_is_in_an_area_is_in_its_boxes) {
  pass_end pass;
  pass.circles = {{place(0), 70}};
  pass.polygons = {{{place(-60, -60), place(60, -60), place(0, 60)}}};
  for (const auto& area : areas_of(pass)) {
    const auto boxes = boxes_of(area);
    for (double east_m = -80; east_m <= 80; east_m += 4)
      for (double north_m = -80; north_m <= 80; north_m += 4)
        EXPECT_TRUE(!contains(area, at(east_m, north_m)) || is_in(boxes, at(east_m, north_m)))
            << east_m << ' ' << north_m;
  }
}

} // namespace view_test
} // namespace godwit::mapobjects_store
