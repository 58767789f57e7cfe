#include "programs/godwit-eyes/detection/detector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "programs/godwit-eyes/detection/classifier.hpp"
#include "programs/godwit-sim/camera/random.hpp"
#include "tests/support/eyes/pose_of_view.hpp"
#include "tests/support/eyes/score.hpp"
#include "tests/support/eyes/small_net.hpp"
#include "tests/support/eyes/suite.hpp"

namespace godwit::eyes {
namespace detector_test {

using sim::camera::suite_case;
using sim::camera::suite_options;
using sim::camera::tier;

constexpr std::int64_t frame_ns = 33'333'333;

suite_options of_size(int width, int height) {
  suite_options options;
  options.width = width;
  options.height = height;
  return options;
}

frame_view view_of(const sim::camera::picture& seen, int number) {
  return {seen.grey.data(), seen.width, seen.height, static_cast<std::size_t>(seen.width), (number + 1) * frame_ns};
}

detector_settings settings_for(const suite_case& flight) {
  detector_settings settings;
  settings.camera = test::parameters_of(flight.maker().glass());
  return settings;
}

// One flight: the score at an overlap of 0.25 after the first second, and how often each reason was given.
struct flown {
  test::score result;
  std::array<int, unusable_count> reasons{};
  int tracks = 0;
};

flown fly(const suite_case& flight, int frames, bool has_pose) {
  flown outcome;
  detector eyes(has_pose ? settings_for(flight) : detector_settings{});
  test::score_rules rules;
  rules.overlap = 0.25;
  rules.width = flight.maker().glass().width;
  rules.height = flight.maker().glass().height;
  std::set<std::uint32_t> numbers;
  for (int n = 0; n < frames; ++n) {
    const auto taken = flight.frame(n);
    const auto frame = view_of(taken.seen, n);
    const auto said =
        has_pose ? eyes.look(frame, test::pose_of(taken.real.view, frame.captured_ns)) : eyes.look(frame, std::nullopt);
    ++outcome.reasons[static_cast<std::size_t>(said.why)];
    std::vector<pixel_box> boxes;
    for (const auto& each : said.confirmed) {
      boxes.push_back(each.box);
      numbers.insert(each.track);
      EXPECT_EQ(each.place.has_value(), has_pose);
    }
    if (n >= 30)
      outcome.result += test::score_of(taken.real, boxes, rules);
  }
  outcome.tracks = static_cast<int>(numbers.size());
  return outcome;
}

int count_of(const flown& outcome, unusable why) { return outcome.reasons[static_cast<std::size_t>(why)]; }

TEST(detector, finds_most_movers_on_a_plane_with_and_without_a_pose) {
  const suite_case flight(sim::camera::tuning_seed(6), tier::a, of_size(1280, 720));
  for (const bool has_pose : {true, false}) {
    const auto outcome = fly(flight, 60, has_pose);
    // Without a pose nothing can be proved: what is new must show itself for longer.
    EXPECT_GT(outcome.result.f1(), has_pose ? 0.85 : 0.8) << (has_pose ? "with" : "without") << " a pose";
  }
}

TEST(detector, works_on_small_pictures_too) {
  const suite_case flight(sim::camera::tuning_seed(6), tier::a, of_size(640, 360));
  EXPECT_GT(fly(flight, 60, true).result.f1(), 0.7);
}

TEST(detector, sees_nothing_where_nothing_moves) {
  for (const std::uint64_t seed : {0U, 3U, 4U}) {
    auto options = of_size(640, 360);
    options.has_movers = false;
    EXPECT_EQ(fly(suite_case(seed, tier::a, options), 60, true).tracks, 0) << "seed " << seed;
  }
}

TEST(detector, follows_a_pan_of_60_degrees_a_second_where_the_pose_is_known) {
  auto options = of_size(640, 360);
  options.pan_deg_s = 60;
  const suite_case flight(sim::camera::tuning_seed(6), tier::a, options);
  const auto outcome = fly(flight, 60, true);
  EXPECT_EQ(count_of(outcome, unusable::no_homography), 0);
  EXPECT_GT(outcome.result.f1(), 0.65);
}

TEST(detector, places_a_mover_on_the_ground) {
  const suite_case flight(sim::camera::tuning_seed(6), tier::a, of_size(1280, 720));
  detector eyes(settings_for(flight));
  int near = 0;
  int all = 0;
  for (int n = 0; n < 50; ++n) {
    auto taken = flight.frame(n);
    const auto frame = view_of(taken.seen, n);
    const auto said = eyes.look(frame, test::pose_of(taken.real.view, frame.captured_ns));
    sim::camera::place_on_earth(taken.real, test::origin_latitude_deg, test::origin_longitude_deg);
    for (const auto& each : said.confirmed) {
      ASSERT_TRUE(each.place);
      ++all;
      near += std::ranges::any_of(taken.real.movers, [&](const auto& real) {
        const double north = (real.latitude_deg - each.place->latitude_deg) * 111180;
        const double east = (real.longitude_deg - each.place->longitude_deg) * 111320 * std::cos(0.8255);
        return std::hypot(north, east) < 4;
      });
    }
  }
  ASSERT_GT(all, 30);
  EXPECT_GT(near, 0.9 * all);
}

// --- reasons
// ----------------------------------------------------------------------------------------------------------

verdict after_good_pictures(const sim::camera::sensor_settings& sensor) {
  const suite_case flight(sim::camera::tuning_seed(1), tier::a, of_size(640, 360));
  auto settings = flight.maker().world().settings();
  settings.sensor = sensor;
  const sim::camera::generator worse(settings, flight.maker().glass());
  detector eyes{detector_settings{}};
  for (int n = 0; n < 10; ++n)
    static_cast<void>(eyes.look(view_of(flight.frame(n).seen, n), std::nullopt));
  const auto last = worse.take(flight.view_at(10 * suite_case::frame_s));
  return eyes.look(view_of(last.seen, 10), std::nullopt);
}

TEST(detector, says_dark_and_blurred) {
  sim::camera::sensor_settings sensor;
  sensor.noise = 1;
  sensor.brightness = 0.02;
  EXPECT_EQ(after_good_pictures(sensor).why, unusable::dark);
  sensor.brightness = 1;
  sensor.defocus_px = 5;
  EXPECT_EQ(after_good_pictures(sensor).why, unusable::blurred);
}

TEST(detector, says_blank_and_repeated) {
  detector eyes{detector_settings{}};
  const std::vector<std::uint8_t> even(640 * 360, 100);
  EXPECT_EQ(eyes.look({even.data(), 640, 360, 640, frame_ns}, std::nullopt).why, unusable::blank);
  const auto taken = suite_case(0, tier::a, of_size(640, 360)).frame(0);
  EXPECT_EQ(eyes.look(view_of(taken.seen, 1), std::nullopt).why, unusable::starting);
  EXPECT_EQ(eyes.look(view_of(taken.seen, 2), std::nullopt).why, unusable::repeated);
}

TEST(detector, says_too_low_too_oblique_and_how_old_an_attitude_is) {
  const suite_case flight(0, tier::a, of_size(640, 360));
  const auto taken = flight.frame(0);
  const auto why_with = [&](auto change) {
    detector eyes(settings_for(flight));
    camera_pose pose = test::pose_of(taken.real.view, frame_ns);
    change(pose);
    return eyes.look(view_of(taken.seen, 0), pose).why;
  };
  EXPECT_EQ(why_with([](camera_pose&) {}), unusable::starting);
  EXPECT_EQ(why_with([](camera_pose& pose) { pose.height_m = 5; }), unusable::too_low);
  EXPECT_EQ(why_with([](camera_pose& pose) {
              pose.attitude = {0.5, 0.5, 0.5, 0.5};
            }),
            unusable::too_oblique); // along the horizon
  EXPECT_EQ(why_with([](camera_pose& pose) {
              pose.at_ns -= 100'000'000;
              pose.rate.z_rad_s = 1;
            }),
            unusable::attitude_old);
  EXPECT_EQ(why_with([](camera_pose& pose) { pose.zoom = std::numeric_limits<double>::quiet_NaN(); }),
            unusable::bad_pose);
}

TEST(detector, has_few_features_on_water_and_begins_anew_after_a_change_of_size) {
  detector eyes{detector_settings{}};
  std::vector<std::uint8_t> waves(640 * 360);
  for (std::size_t n = 0; n < 3; ++n) {
    for (std::size_t at = 0; at < waves.size(); ++at) // edges that no corner is in
      waves[at] = static_cast<std::uint8_t>(80 + (at % 640 / 20 + n) % 2 * 40);
    const auto said =
        eyes.look({waves.data(), 640, 360, 640, static_cast<std::int64_t>(n + 1) * frame_ns}, std::nullopt);
    EXPECT_EQ(said.why, n == 0 ? unusable::starting : unusable::few_features);
  }
  const auto taken = suite_case(0, tier::a, of_size(320, 180)).frame(0);
  EXPECT_EQ(eyes.look(view_of(taken.seen, 5), std::nullopt).why, unusable::starting);
}

// --- frames as they should not be
// -------------------------------------------------------------------------------------

RC_GTEST_PROP(detector, a_frame_of_any_size_and_stride_is_looked_at_or_refused, ()) {
  const int width = *rc::gen::inRange(-10, 900);
  const int height = *rc::gen::inRange(-10, 300);
  const auto stride = static_cast<std::size_t>(*rc::gen::inRange(0, 1000));
  const bool is_right = width >= 64 && height >= 64 && stride >= static_cast<std::size_t>(width);
  std::vector<std::uint8_t> pixels(is_right ? stride * static_cast<std::size_t>(height) : 1);
  sim::camera::random_source random(7);
  for (auto& each : pixels)
    each = static_cast<std::uint8_t>(random.next());
  detector eyes{detector_settings{}};
  for (int n = 0; n < 3; ++n) {
    pixels[0] = static_cast<std::uint8_t>(n * 50);
    const auto said = eyes.look({pixels.data(), width, height, stride, (n + 1) * frame_ns}, std::nullopt);
    RC_ASSERT((said.why == unusable::bad_frame) == !is_right);
    RC_ASSERT(said.confirmed.empty());
  }
}

TEST(detector, a_stride_beyond_the_width_changes_nothing) {
  const suite_case flight(1, tier::a, of_size(320, 180));
  detector plain{detector_settings{}};
  detector padded{detector_settings{}};
  for (int n = 0; n < 12; ++n) {
    const auto taken = flight.frame(n);
    std::vector<std::uint8_t> wide(400 * 180, static_cast<std::uint8_t>(n));
    for (std::size_t y = 0; y < 180; ++y)
      std::copy_n(&taken.seen.grey[y * 320], 320, &wide[y * 400]);
    const auto a = plain.look(view_of(taken.seen, n), std::nullopt);
    const auto b = padded.look({wide.data(), 320, 180, 400, (n + 1) * frame_ns}, std::nullopt);
    EXPECT_EQ(a.why, b.why);
    EXPECT_EQ(a.figures.homography, b.figures.homography);
  }
}

TEST(detector_settings, what_can_not_be_is_named) {
  detector_settings settings;
  EXPECT_FALSE(problem_of(settings));
  settings.frames_to_confirm = 0;
  ASSERT_TRUE(problem_of(settings));
  EXPECT_NE(problem_of(settings)->find("frames_to_confirm"), std::string::npos);
  settings = {};
  settings.camera.emplace();
  ASSERT_TRUE(problem_of(settings));
  EXPECT_NE(problem_of(settings)->find("camera: width"), std::string::npos);
}

TEST(unusable, each_reason_has_a_name_and_a_sentence) {
  std::set<std::string_view> names;
  for (int n = 0; n < unusable_count; ++n) {
    names.insert(name_of(static_cast<unusable>(n)));
    EXPECT_FALSE(sentence_of(static_cast<unusable>(n)).empty());
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(unusable_count));
}

TEST(detector, with_a_net_what_it_recognises_has_its_class_and_box_and_without_one_nothing_has) {
  const suite_case flight(sim::camera::tuning_seed(6), tier::a, of_size(640, 360));
  const auto net = classifier::make(test::small_net()).value();
  detector alone(settings_for(flight));
  detector eyes(settings_for(flight), net);
  int recognised = 0;
  for (int n = 0; n < 60; ++n) {
    const auto taken = flight.frame(n);
    const auto view = view_of(taken.seen, n);
    for (const auto& each : alone.look(view, test::pose_of(taken.real.view, view.captured_ns)).confirmed)
      EXPECT_EQ(each.looks_like, object_class::unknown);
    for (const auto& each : eyes.look(view, test::pose_of(taken.real.view, view.captured_ns)).confirmed)
      recognised += each.looks_like == object_class::person ? 1 : 0;
  }
  EXPECT_GT(recognised, 20);
}

} // namespace detector_test
} // namespace godwit::eyes
