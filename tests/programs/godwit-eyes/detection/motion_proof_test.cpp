#include "programs/godwit-eyes/detection/motion_proof.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "programs/godwit-sim/camera/random.hpp"

namespace godwit::eyes {
namespace motion_proof_test {

constexpr double picture_s = 1.0 / 30;
constexpr int thing_px = 11;

cv::Mat textured(const cv::Size& size, std::uint64_t seed) {
  sim::camera::random_source random(seed);
  cv::Mat made(size, CV_8UC1);
  for (int y = 0; y < made.rows; ++y)
    for (int x = 0; x < made.cols; ++x)
      made.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(random.between(40, 215));
  cv::GaussianBlur(made, made, cv::Size(5, 5), 1.2);
  return made;
}

// A track over a still ground, and what the pictures show of it.
struct followed {
  followed() : who{1, track_filter({100, 100}, 1), cv::Size2d(thing_px, thing_px), {100, 100}} {}

  // FOLLOWED_TO: where the tracker takes it to be; the thing itself is painted at SHOWN.
  void see(const cv::Point& followed_to, const cv::Point& shown, const cv::Matx33d& ground_moved = cv::Matx33d::eye()) {
    cv::Mat picture = ground.clone();
    if (has_thing)
      thing.copyTo(picture(cv::Rect(shown - cv::Point(thing_px / 2, thing_px / 2), thing.size())));
    proof.add(picture, picture_s, ground_moved);
    who.age = ++who.seen;
    const double half = thing_px / 2.0;
    who.places.push_back({who.age, {followed_to.x + 0.5 - half, followed_to.y + 0.5 - half, thing_px, thing_px}});
  }
  cv::Mat ground = textured({320, 200}, 1);
  cv::Mat thing = textured({thing_px, thing_px}, 2);
  bool has_thing = true;
  motion_proof proof;
  track who;
};

TEST(motion_proof, what_looks_there_as_it_looked_here_has_moved) {
  followed f;
  for (int n = 0; n < 10; ++n)
    f.see({100 + 2 * n, 100 + n}, {100 + 2 * n, 100 + n});
  EXPECT_TRUE(f.proof.has_moved(f.who, {}));
}

TEST(motion_proof, what_is_joined_by_chance_on_ground_that_stays_has_not) {
  followed f;
  f.has_thing = false;
  for (int n = 0; n < 10; ++n)
    f.see({100 + 2 * n, 100}, {});
  EXPECT_FALSE(f.proof.has_moved(f.who, {}));
}

TEST(motion_proof, what_stands_high_goes_along_the_line_that_the_flight_makes_of_it_and_proves_nothing) {
  followed f;
  for (int n = 0; n < 10; ++n)
    f.see({100 + 2 * n, 100}, {100 + 2 * n, 100});
  const cv::Point2d along(120, 0); // 4 pixels a picture, of the highest
  EXPECT_FALSE(f.proof.has_moved(f.who, {along, 1}));
  EXPECT_TRUE(f.proof.has_moved(f.who, {-along, 1})) << "the other way nothing still goes";
  EXPECT_TRUE(f.proof.has_moved(f.who, {{0, 120}, 1})) << "nor across";
}

TEST(motion_proof, what_stays_within_its_sway_proves_nothing) {
  followed f;
  for (int n = 0; n < 8; ++n)
    f.see({100 + n, 100}, {100 + n, 100});
  EXPECT_FALSE(f.proof.has_moved(f.who, {{}, 8}));
  EXPECT_TRUE(f.proof.has_moved(f.who, {{}, 2}));
}

TEST(motion_proof, a_way_along_an_edge_that_looks_alike_all_along_proves_nothing) {
  followed f;
  f.has_thing = false;
  f.ground(cv::Rect(0, 100, 320, 100)) = 200;
  f.ground(cv::Rect(0, 0, 320, 100)) = 60;
  for (int n = 0; n < 10; ++n)
    f.see({100 + 2 * n, 100}, {});
  EXPECT_FALSE(f.proof.has_moved(f.who, {}));
}

TEST(motion_proof, what_keeps_its_place_in_the_picture_while_the_ground_goes_by_has_moved) {
  const cv::Mat wide = textured({640, 200}, 1);
  const cv::Matx33d by(1, 0, -3, 0, 1, 0, 0, 0, 1);
  followed f;
  for (int n = 0; n < 10; ++n) {
    f.ground = wide(cv::Rect(3 * n, 0, 320, 200));
    f.see({100, 100}, {100, 100}, by);
  }
  EXPECT_TRUE(f.proof.has_moved(f.who, {}));
}

TEST(motion_proof, without_earlier_pictures_nothing_is_proved) {
  followed f;
  EXPECT_FALSE(f.proof.has_moved(f.who, {}));
  f.see({100, 100}, {100, 100});
  EXPECT_FALSE(f.proof.has_moved(f.who, {}));
  f.proof.forget();
  EXPECT_FALSE(f.proof.has_moved(f.who, {}));
}

} // namespace motion_proof_test
} // namespace godwit::eyes
