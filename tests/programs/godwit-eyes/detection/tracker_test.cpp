#include "programs/godwit-eyes/detection/tracker.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "programs/godwit-sim/camera/random.hpp"

namespace godwit::eyes {
namespace tracker_test {

constexpr double picture_s = 1.0 / 30;
const cv::Size picture(640, 360);
const cv::Matx33d still = cv::Matx33d::eye();

blob blob_at(double x, double y, double size = 10) {
  return {cv::Rect2d(x - size / 2, y - size / 2, size, size), static_cast<int>(size * size), 50};
}

blob of_difference(blob made, blob_source from = blob_source::difference) {
  made.from = from;
  return made;
}

// With blobs of the background alone, and their clutter.
class followed : public tracker {
public:
  // The background finds nothing until it knows the ground.
  explicit followed(const tracker_settings& settings) : tracker(settings) {
    for (int n = 0; n < 8; ++n)
      clutter_.step({}, picture_s, still, picture);
  }
  void step(std::span<const blob> blobs, double dt_s, const cv::Matx33d& ground, const cv::Size& size,
            const prover& proves = {}) {
    clutter_.step(blobs, dt_s, ground, size);
    tracker::step({blobs, {}, {}}, clutter_, dt_s, ground, size, proves);
  }

private:
  clutter_map clutter_;
};

int confirmed(const tracker& of) {
  return static_cast<int>(std::ranges::count_if(of.tracks(), [](const track& each) { return each.is_confirmed; }));
}

TEST(tracker, what_moves_is_confirmed_and_keeps_its_number) {
  followed of({});
  std::set<std::uint32_t> numbers;
  for (int n = 0; n < 40; ++n) {
    of.step(std::vector{blob_at(100 + 2.0 * n, 100)}, picture_s, still, picture);
    for (const auto& each : of.tracks())
      if (each.is_confirmed)
        numbers.insert(each.number);
  }
  EXPECT_EQ(numbers.size(), 1U);
  EXPECT_EQ(of.tracks().size(), 1U);
}

TEST(tracker, it_takes_as_many_pictures_as_the_settings_say) {
  followed of({.frames_to_confirm = 30, .max_tracks = 64});
  for (int n = 0; n < 29; ++n) {
    of.step(std::vector{blob_at(100 + 4.0 * n, 100)}, picture_s, still, picture);
    EXPECT_EQ(confirmed(of), 0);
  }
  of.step(std::vector{blob_at(216, 100)}, picture_s, still, picture);
  EXPECT_EQ(confirmed(of), 1);
}

// Empty pictures, until the scene is known to be calm.
void look_at_nothing(followed& of, const cv::Matx33d& ground) {
  for (int n = 0; n < 40; ++n)
    of.step({}, picture_s, ground, picture);
}

TEST(tracker, what_stands_and_comes_in_over_the_border_is_never_confirmed) {
  followed of({});
  const cv::Matx33d ground(1, 0, -3, 0, 1, 0, 0, 0, 1);
  look_at_nothing(of, ground);
  for (int n = 0; n < 60; ++n) {
    // As much of it as lies on ground that three pictures have seen; so its middle goes against the ground.
    const double left = 630 - 3 * n;
    const double right = std::min(left + 60, 640.0 - 9);
    std::vector<blob> seen;
    if (right - left >= 3)
      seen.push_back({cv::Rect2d(left, 100, right - left, 20), 200, 50});
    of.step(seen, picture_s, ground, picture);
    EXPECT_EQ(confirmed(of), 0) << n;
  }
}

TEST(tracker, what_moves_and_comes_in_over_the_border_is_confirmed_when_it_was_seen_whole) {
  followed of({});
  look_at_nothing(of, still);
  int first = 0;
  for (int n = 1; n < 40 && first == 0; ++n) {
    const double right = std::min(4.0 * n, 640.0);
    of.step(std::vector{blob{cv::Rect2d(std::max(right - 20, 0.0), 100, std::min(right, 20.0), 20), 200, 50}},
            picture_s, still, picture);
    first = confirmed(of) > 0 ? n : 0;
  }
  EXPECT_GE(first, 5 + 4) << "in the fifth picture it touches the border for the last time";
  EXPECT_LE(first, 5 + 12);
}

TEST(tracker, a_scene_is_cluttered_until_pictures_show_that_it_is_not) {
  followed of({});
  const auto never = [](const track&) { return false; };
  int first = 0;
  for (int n = 0; n < 40 && first == 0; ++n) {
    of.step(std::vector{blob_at(100 + 3.0 * n, 100)}, picture_s, still, picture, never);
    first = confirmed(of) > 0 ? n : 0;
  }
  EXPECT_GT(first, 9);
  EXPECT_LT(first, 30);
}

TEST(tracker, what_stays_or_goes_to_and_fro_is_never_confirmed) {
  followed of({});
  for (int n = 0; n < 100; ++n) {
    const std::vector blobs{blob_at(100, 100), blob_at(300 + 1.5 * std::sin(n * 0.5), 200)};
    of.step(blobs, picture_s, still, picture);
    EXPECT_EQ(confirmed(of), 0);
  }
}

TEST(tracker, what_stays_on_the_ground_while_the_camera_moves_is_never_confirmed) {
  followed of({});
  const cv::Matx33d ground(1, 0, 3, 0, 1, 1, 0, 0, 1);
  for (int n = 0; n < 60; ++n) {
    of.step(std::vector{blob_at(100 + 3.0 * n, 100 + 1.0 * n)}, picture_s, ground, picture);
    EXPECT_EQ(confirmed(of), 0);
  }
}

// Forty pictures of one thing that moves, among as many flickers a picture; how often it was confirmed.
int confirmed_among(int flickers, const tracker::prover& proves) {
  sim::camera::random_source random(7);
  followed of({});
  int count = 0;
  for (int n = 0; n < 40; ++n) {
    std::vector<blob> blobs{blob_at(100 + 3.0 * n, 100)};
    for (int k = 0; k < flickers; ++k)
      blobs.push_back(blob_at(random.between(0, 640), random.between(150, 360), 4));
    of.step(blobs, picture_s, still, picture, proves);
    count += confirmed(of);
  }
  return count;
}

// Of one thing among flickers, about which a classifier says the same each picture.
int confirmed_among_flickers(const std::function<void(appearance&)>& says) {
  sim::camera::random_source random(7);
  followed of({});
  int count = 0;
  for (int n = 0; n < 40; ++n) {
    std::vector<blob> blobs{blob_at(100 + 3.0 * n, 100)};
    for (int k = 0; k < 5; ++k)
      blobs.push_back(blob_at(random.between(60, 300), random.between(110, 180), 4));
    of.step(blobs, picture_s, still, picture);
    for (auto& each : of.tracks())
      if (each.filter.place().y < 105)
        says(each.looks);
    count += confirmed(of);
  }
  return count;
}

TEST(tracker, what_is_recognised_is_confirmed_sooner_and_what_should_have_been_is_not) {
  const int alone = confirmed_among_flickers([](appearance&) {});
  const int recognised = confirmed_among_flickers(
      [](appearance& looks) { looks.add_recognised(io::eyes::object_class::person, 0.9, {}); });
  EXPECT_GE(recognised, alone + 10);
  EXPECT_GE(recognised, 30);
  EXPECT_GT(confirmed_among_flickers([](appearance& looks) { looks.add_unrecognised(false); }), 0)
      << "it could not have been recognised";
  EXPECT_EQ(confirmed_among_flickers([](appearance& looks) { looks.add_unrecognised(true); }), 0);
}

TEST(tracker, what_is_recognised_and_stays_is_never_confirmed) {
  followed of({});
  for (int n = 0; n < 100; ++n) {
    of.step(std::vector{blob_at(100, 100), blob_at(300 + 1.5 * std::sin(n * 0.5), 200)}, picture_s, still, picture);
    for (auto& each : of.tracks())
      each.looks.add_recognised(io::eyes::object_class::person, 0.9, {});
    EXPECT_EQ(confirmed(of), 0);
  }
}

TEST(tracker, among_clutter_what_is_not_proved_is_not_confirmed) {
  const auto never = [](const track&) { return false; };
  const auto always = [](const track&) { return true; };
  EXPECT_EQ(confirmed_among(5, never), 0);
  EXPECT_GT(confirmed_among(5, always), 20);
  EXPECT_GT(confirmed_among(0, never), 20) << "where there is no clutter no proof is asked for";
}

TEST(tracker, flickers_at_random_places_are_never_confirmed) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    sim::camera::random_source random(seed);
    followed of({});
    for (int n = 0; n < 200; ++n) {
      std::vector<blob> blobs;
      for (int k = 0; k < 5; ++k)
        blobs.push_back(blob_at(random.between(0, 640), random.between(0, 360), 4));
      of.step(blobs, picture_s, still, picture);
      EXPECT_EQ(confirmed(of), 0) << "seed " << seed;
    }
  }
}

// Two that pass each other at a distance keep their numbers; each blob goes to one track.
// A crown in the wind goes straight for a while, and never farther than it is wide.
TEST(tracker, among_clutter_what_sways_within_its_own_size_is_never_confirmed_and_what_leaves_it_is) {
  followed of({});
  sim::camera::random_source random(3);
  std::set<std::uint32_t> swaying;
  std::set<std::uint32_t> going;
  for (int n = 0; n < 160; ++n) {
    std::vector<blob> seen;
    for (int k = 0; k < 5; ++k)
      seen.push_back(blob_at(random.between(20, 620), random.between(200, 340), 6));
    if (n >= 40) {
      seen.push_back(blob_at(100 + 1.3 * std::abs((n - 40 + 14) % 28 - 14), 60, 20)); // to and fro in a second
      seen.push_back(blob_at(100 + 2.0 * (n - 40), 130, 20));
    }
    of.step(seen, picture_s, still, picture);
    for (const auto& each : of.tracks())
      if (each.is_confirmed && each.filter.place().y < 160)
        (each.filter.place().y < 95 ? swaying : going).insert(each.number);
  }
  EXPECT_TRUE(swaying.empty());
  EXPECT_EQ(going.size(), 1U);
}

RC_GTEST_PROP(tracker, a_blob_belongs_to_one_track_and_a_number_to_one_thing, ()) {
  sim::camera::random_source random(*rc::gen::arbitrary<std::uint64_t>());
  followed of({});
  const double speed = random.between(0.8, 3);
  std::set<std::uint32_t> of_first;
  std::set<std::uint32_t> of_second;
  for (int n = 0; n < 60; ++n) {
    const auto shake = [&] { return random.between(-0.5, 0.5); };
    const double first = 100 + speed * n;
    const double second = 400 - speed * n;
    of.step(std::vector{blob_at(first + shake(), 100 + shake()), blob_at(second + shake(), 150 + shake())}, picture_s,
            still, picture);
    RC_ASSERT(of.tracks().size() == 2);
    for (const auto& each : of.tracks())
      if (each.is_confirmed)
        (each.filter.place().y < 125 ? of_first : of_second).insert(each.number);
  }
  RC_ASSERT(of_first.size() == 1);
  RC_ASSERT(of_second.size() == 1);
}

TEST(tracker, of_more_things_than_it_can_follow_the_weakest_are_dropped) {
  followed of({.frames_to_confirm = 5, .max_tracks = 5});
  for (int n = 0; n < 40; ++n) {
    std::vector<blob> blobs{blob_at(100 + 3.0 * n, 100)};
    if (n >= 30) // by then it is confirmed
      for (int k = 0; k < 6; ++k)
        blobs.push_back(blob_at(20.0 + 90 * k, 200 + 5 * (n % 7)));
    of.step(blobs, picture_s, still, picture);
    EXPECT_LE(of.tracks().size(), 5U);
  }
  EXPECT_EQ(confirmed(of), 1);
}

TEST(tracker, what_is_thin_is_an_edge_of_something_and_never_confirmed) {
  followed of({});
  for (int n = 0; n < 60; ++n)
    of.step(std::vector{blob{cv::Rect2d(100 + 3.0 * n, 100, 3, 40), 120, 50}}, picture_s, still, picture);
  EXPECT_EQ(confirmed(of), 0);
}

// Flickers of the background all over the picture.
std::vector<blob> flickers(sim::camera::random_source& random) {
  std::vector<blob> made;
  for (int k = 0; k < 30; ++k)
    made.push_back(blob_at(random.between(0, 640), random.between(0, 360), 6));
  return made;
}

TEST(tracker, where_the_background_is_cluttered_what_the_difference_finds_is_confirmed) {
  sim::camera::random_source random(7);
  tracker of({});
  clutter_map clutter;
  for (int n = 0; n < 60; ++n) {
    const auto background = flickers(random);
    clutter.step(background, picture_s, still, picture);
    of.step({background, std::vector{of_difference(blob_at(100 + 4.0 * n, 100, 12))}, {}}, clutter, picture_s, still,
            picture);
  }
  ASSERT_EQ(confirmed(of), 1);
  EXPECT_GE(of.tracks()[0].age_s, 0.5);
  EXPECT_EQ(of.tracks().size(), 1U) << "flickers of a cluttered background begin no tracks";
  EXPECT_TRUE(of.needs_differences());
}

TEST(tracker, what_slows_down_is_followed_on_by_the_slow_difference) {
  sim::camera::random_source random(7);
  tracker of({});
  clutter_map clutter;
  double x = 100;
  for (int n = 0; n < 90; ++n) {
    x += n < 60 ? 4 : 0.5;
    const auto background = flickers(random);
    clutter.step(background, picture_s, still, picture);
    const std::vector quick{of_difference(blob_at(x, 100, 12))};
    const std::vector slow{of_difference(blob_at(x, 100, 12), blob_source::slow_difference)};
    of.step({background, n < 60 ? quick : std::vector<blob>{}, slow}, clutter, picture_s, still, picture);
  }
  ASSERT_EQ(of.tracks().size(), 1U);
  EXPECT_TRUE(of.tracks()[0].is_confirmed);
  EXPECT_EQ(of.tracks()[0].missed, 0);
}

// Of what goes slowly the quick difference shows the edge in front; the slow one shows all of it.
TEST(tracker, what_goes_slowly_is_as_large_as_the_slow_difference_shows) {
  sim::camera::random_source random(7);
  tracker of({});
  clutter_map clutter;
  for (int n = 0; n < 90; ++n) {
    const double x = 100 + 0.9 * n;
    std::vector<blob> background;
    for (int k = 0; k < 20; ++k)
      background.push_back(blob_at(random.between(400, 640), random.between(0, 360), 6));
    if (n % 5 == 0) // there is some clutter around it
      background.push_back(blob_at(x + random.between(-60, 60), 60, 6));
    clutter.step(background, picture_s, still, picture);
    of.step({background, std::vector{of_difference(blob_at(x, 100, 6))},
             std::vector{of_difference(blob_at(x - 4, 100, 20), blob_source::slow_difference)}},
            clutter, picture_s, still, picture);
  }
  ASSERT_EQ(confirmed(of), 1);
  const auto shown = extent_of(of.tracks()[0]);
  EXPECT_NEAR(shown.width, 20, 3);
  EXPECT_NEAR(middle_of(shown).x, 100 + 0.9 * 89 - 4, 2);
}

TEST(tracker, a_track_that_is_hidden_for_a_while_goes_on_by_its_speed) {
  followed of({});
  for (int n = 0; n < 20; ++n)
    of.step(std::vector{blob_at(100 + 3.0 * n, 100)}, picture_s, still, picture);
  ASSERT_EQ(confirmed(of), 1);
  const auto number = of.tracks()[0].number;
  for (int n = 20; n < 26; ++n)
    of.step({}, picture_s, still, picture);
  of.step(std::vector{blob_at(100 + 3.0 * 26, 100)}, picture_s, still, picture);
  ASSERT_EQ(of.tracks().size(), 1U);
  EXPECT_EQ(of.tracks()[0].number, number);
}

} // namespace tracker_test
} // namespace godwit::eyes
