#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "programs/godwit-sim/camera/generator.hpp"
#include "programs/godwit-sim/camera/ground_painter.hpp"
#include "tests/support/eyes/suite.hpp"

namespace godwit::sim::camera {

namespace generator_test {

lens small_lens() { return {.width = 320, .height = 180, .focal_px = 300, .readout_s = 0}; }

camera_view above(double north, double east) {
  camera_view view;
  view.position = {north, east, -50};
  view.attitude = rotation_of(0.3, 0.4, 0);
  return view;
}

TEST(camera_generator, the_same_seed_view_and_time_give_the_same_picture) {
  for (const tier which : {tier::a, tier::b}) {
    suite_options options;
    options.width = 320;
    options.height = 180;
    const auto once = suite_case(4, which, options).frame(20);
    const auto twice = suite_case(4, which, options).frame(20);
    EXPECT_EQ(once.seen.grey, twice.seen.grey);
    const auto other = suite_case(6, which, options).frame(20);
    EXPECT_NE(once.seen.grey, other.seen.grey);
  }
}

// A picture with a mover and one without differ where the truth says that the mover is, and nowhere else.
TEST(camera_generator, the_true_box_is_where_the_pixels_differ) {
  for (int n = 0; n < 8; ++n) {
    auto settings = tier_a(12);
    settings.sensor.noise = 0;
    const generator empty(settings, small_lens());
    mover who;
    who.id = 9;
    who.start = {20.0 + n, 4.0 * n - 12};
    who.heading_rad = n * 0.7;
    who.brightness = 235;
    settings.movers = {who};
    const generator with(settings, small_lens());
    const auto view = above(0, 0);
    const auto a = empty.take(view);
    const auto b = with.take(view);
    ASSERT_EQ(b.real.movers.size(), 1U);
    double left = 1e9;
    double right = -1;
    double top = 1e9;
    double bottom = -1;
    for (int y = 0; y < 180; ++y)
      for (int x = 0; x < 320; ++x) {
        const auto at = static_cast<std::size_t>(y * 320 + x);
        if (std::abs(a.seen.grey[at] - b.seen.grey[at]) < 12)
          continue;
        left = std::min<double>(left, x);
        right = std::max<double>(right, x + 1);
        top = std::min<double>(top, y);
        bottom = std::max<double>(bottom, y + 1);
      }
    const auto& box = b.real.movers[0];
    EXPECT_NEAR(left, box.x_px, 1.6);
    EXPECT_NEAR(right, box.x_px + box.width_px, 1.6);
    EXPECT_NEAR(top, box.y_px, 1.6);
    EXPECT_NEAR(bottom, box.y_px + box.height_px, 1.6);
    EXPECT_EQ(box.visible_share, 1);
    EXPECT_FALSE(box.is_cut);
  }
}

TEST(camera_generator, the_ground_stays_where_it_is_when_the_camera_moves) {
  auto settings = tier_a(3);
  settings.sensor.noise = 0;
  const generator maker(settings, small_lens());
  const auto first = above(0, 0);
  const auto second = above(1.5, -1);
  const auto a = maker.take(first);
  const auto b = maker.take(second);
  const row_views from(maker.glass(), first);
  const row_views to(maker.glass(), second);
  double error = 0;
  int count = 0;
  for (int y = 40; y < 140; y += 7)
    for (int x = 60; x < 260; x += 7) {
      const auto place = ground_at(maker.world(), from, x, y);
      ASSERT_TRUE(place);
      const auto there = to.project(*place);
      ASSERT_TRUE(there);
      const int u = static_cast<int>(std::lround(there->x));
      const int v = static_cast<int>(std::lround(there->y));
      error += std::abs(a.seen.grey[static_cast<std::size_t>(y * 320 + x)] -
                        b.seen.grey[static_cast<std::size_t>(v * 320 + u)]);
      ++count;
    }
  EXPECT_LT(error / count, 3.5); // half a pixel of rounding
}

TEST(camera_generator, what_stands_in_front_hides_a_mover) {
  auto settings = tier_b(1);
  settings.buildings_a_cell = 0;
  settings.glints_a_cell = 0;
  settings.trees_a_cell = 60; // a wood
  for (int n = 0; n < 30; ++n) {
    mover who;
    who.id = static_cast<std::uint32_t>(n + 1);
    who.start = {10.0 + 2 * (n % 6), 3.0 * (n / 6) - 8};
    settings.movers.push_back(who);
  }
  const auto taken = generator(settings, small_lens()).take(above(0, 0));
  const auto is_hidden = [](const true_mover& each) { return each.visible_share < 0.9; };
  EXPECT_TRUE(std::ranges::any_of(taken.real.movers, is_hidden));
}

TEST(camera_generator, a_view_above_the_horizon_is_sky_and_no_crash) {
  camera_view view;
  view.position = {0, 0, -30};
  view.attitude = rotation_of(0, 2.0, 0); // 115 degrees off the nadir
  const auto taken = generator(tier_b(2), small_lens()).take(view);
  EXPECT_EQ(taken.seen.grey.size(), 320U * 180U);
}

TEST(camera_generator, colours_follow_the_brightness) {
  picture grey{2, 1, {10, 200}};
  const auto colours = bgr_of(grey);
  ASSERT_EQ(colours.size(), 6U);
  EXPECT_EQ(colours[1], 10);
  EXPECT_EQ(colours[4], 200);
}

} // namespace generator_test

namespace truth_test {

TEST(camera_truth, a_line_is_json_and_ends) {
  truth what;
  what.time_s = 1.5;
  auto& person = what.movers.emplace_back();
  person.kind = "person";
  person.width_px = 5;
  const auto line = json_line(what);
  EXPECT_EQ(line.back(), '\n');
  const auto read = nlohmann::json::parse(line);
  EXPECT_EQ(read["time_s"], 1.5);
  EXPECT_EQ(read["movers"][0]["kind"], "person");
  EXPECT_EQ(read["movers"][0]["width_px"], 5);
}

TEST(camera_truth, a_place_north_of_the_origin_has_a_higher_latitude) {
  truth what;
  what.movers.emplace_back().north_m = 1000;
  place_on_earth(what, 47, 8);
  EXPECT_NEAR(what.movers[0].latitude_deg, 47 + 1000 / 111180.0, 1e-5);
  EXPECT_NEAR(what.movers[0].longitude_deg, 8, 1e-9);
}

} // namespace truth_test

} // namespace godwit::sim::camera
