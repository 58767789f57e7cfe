#include "programs/godwit-eyes/detection/track_filter.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "programs/godwit-sim/camera/random.hpp"

namespace godwit::eyes {
namespace track_filter_test {

constexpr double step_s = 1.0 / 30;

RC_GTEST_PROP(track_filter, the_covariance_stays_symmetric_and_positive, ()) {
  sim::camera::random_source random(*rc::gen::arbitrary<std::uint64_t>());
  track_filter filter({random.between(0, 640), random.between(0, 360)}, 1);
  for (int n = 0; n < 60; ++n) {
    cv::Matx33d ground = cv::Matx33d::eye();
    for (int row = 0; row < 2; ++row) {
      for (int column = 0; column < 2; ++column)
        ground(row, column) += random.between(-0.05, 0.05);
      ground(row, 2) += random.between(-20, 20);
      ground(2, row) += random.between(-1e-5, 1e-5);
    }
    filter.predict(random.between(0.005, 0.4), ground);
    if (random.uniform() < 0.7)
      filter.update({random.between(0, 640), random.between(0, 360)}, random.between(0.3, 10));
    const auto& covariance = filter.covariance();
    RC_ASSERT((covariance - covariance.transpose()).cwiseAbs().maxCoeff() < 1e-6 * covariance.cwiseAbs().maxCoeff());
    RC_ASSERT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(covariance).eigenvalues().minCoeff() > 0);
  }
}

TEST(track_filter, finds_a_constant_speed_from_places_with_noise) {
  sim::camera::random_source random(5);
  track_filter filter({100, 100}, 1);
  for (int n = 1; n <= 60; ++n) {
    filter.predict(step_s, cv::Matx33d::eye());
    filter.update({100 + 45 * n * step_s + random.gaussian(), 100 - 30 * n * step_s + random.gaussian()}, 1);
  }
  EXPECT_NEAR(filter.velocity().x, 45, 12);
  EXPECT_NEAR(filter.velocity().y, -30, 12);
  EXPECT_NEAR(filter.place().x, 190, 1.5);
}

TEST(track_filter, a_moving_camera_is_no_speed) {
  track_filter filter({300, 200}, 0.5);
  const cv::Matx33d ground(1, 0, 7, 0, 1, -4, 0, 0, 1);
  cv::Point2d place(300, 200);
  for (int n = 0; n < 30; ++n) {
    place += cv::Point2d(7, -4);
    filter.predict(step_s, ground);
    filter.update(place, 0.5);
  }
  EXPECT_NEAR(cv::norm(filter.velocity()), 0, 1e-6);
  EXPECT_NEAR(filter.place().x, place.x, 1e-6);
}

TEST(track_filter, is_surer_where_it_was_seen_than_where_it_was_not) {
  track_filter seen({0, 0}, 1);
  track_filter lost({0, 0}, 1);
  for (int n = 0; n < 10; ++n) {
    seen.predict(step_s, cv::Matx33d::eye());
    lost.predict(step_s, cv::Matx33d::eye());
    seen.update({0, 0}, 1);
  }
  EXPECT_GT(seen.distance_squared({5, 0}, 1), lost.distance_squared({5, 0}, 1));
}

} // namespace track_filter_test
} // namespace godwit::eyes
