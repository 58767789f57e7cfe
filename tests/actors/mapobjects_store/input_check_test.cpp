#include "actors/mapobjects_store/input_check.hpp"

#include <limits>

#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {
namespace input_check_test {

using namespace godwit::tests;

template <class Input, class Change>
std::string refusal(Input input, const Change& change) {
  EXPECT_TRUE(check(input).has_value());
  change(input);
  const auto done = check(input);
  return done ? "" : done.error().what;
}

TEST(input_check, each_field_of_a_sighting_is_looked_at) {
  const auto good = seen(1, place(0));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(good, [](auto& s) { s.id = "1"; }).find("id"), std::string::npos);
  EXPECT_NE(refusal(good, [](auto& s) { s.mission_id.clear(); }).find("mission_id"), std::string::npos);
  EXPECT_NE(refusal(good, [](auto& s) { s.class_group.clear(); }).find("class_group"), std::string::npos);
  EXPECT_NE(refusal(good, [](auto& s) { s.class_group = std::string(65, 'x'); }).find("64"), std::string::npos);
  EXPECT_NE(refusal(good, [&](auto& s) { s.position.latitude_deg = nan; }).find("position"), std::string::npos);
  EXPECT_NE(refusal(good, [&](auto& s) { s.position.altitude_m = nan; }).find("altitude"), std::string::npos);
  EXPECT_NE(refusal(good, [&](auto& s) { s.confidence = nan; }).find("confidence"), std::string::npos);
}

TEST(input_check, the_areas_of_a_pass_are_bounded) {
  const pass_end good{.id = uuid(1),
                      .mission_id = mission_a,
                      .started_ns = 1,
                      .ended_ns = 2,
                      .class_groups = {"vehicle"},
                      .circles = {{place(0), 10}},
                      .polygons = {{{place(0), place(10), place(0, 10)}}},
                      .confidence = 1};
  EXPECT_NE(refusal(good, [](auto& p) { p.class_groups.clear(); }), "");
  EXPECT_NE(refusal(good, [](auto& p) { p.circles.resize(max_view_circles + 1); }), "");
  EXPECT_NE(refusal(good, [](auto& p) { p.polygons.resize(max_view_polygons + 1); }), "");
  EXPECT_NE(refusal(good, [](auto& p) { p.polygons[0].vertices.pop_back(); }), "");
  EXPECT_NE(refusal(good, [](auto& p) { p.polygons[0].vertices.resize(max_view_vertices + 1); }), "");
  EXPECT_NE(refusal(good, [](auto& p) { p.polygons[0].vertices[1].latitude_deg = 0; }), "");
  EXPECT_NE(refusal(good, [](auto& p) { p.circles[0].radius_m = 2 * max_view_radius_m; }), "");
}

TEST(input_check, an_ignored_item_gets_the_one_form_of_its_cell) {
  ignored_item item{.id = uuid(1), .mission_id = mission_a, .mgrs_cell = "4QFJ1234", .class_group = "vehicle"};
  EXPECT_EQ(checked(item)->mgrs_cell, "04QFJ1234");
  item.mgrs_cell = "somewhere";
  EXPECT_FALSE(checked(item));
}

TEST(input_check, what_is_quoted_in_an_error_is_bounded) {
  auto bad = seen(1, place(0));
  bad.id = std::string(1'000'000, 'x');
  EXPECT_LT(check(bad).error().what.size(), 200U);
}

} // namespace input_check_test
} // namespace godwit::mapobjects_store
