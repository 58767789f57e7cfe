#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace camera_test {

using namespace test;

verdict with(camera_state camera) {
  auto seen = good_facts();
  seen.camera.state = camera;
  return check_camera(seen, {}).how;
}

TEST(camera_check, passes_when_it_is_ready) { EXPECT_EQ(with(camera_state::ready), verdict::pass); }

TEST(camera_check, degrades_when_it_is_on_and_not_ready) {
  EXPECT_EQ(with(camera_state::not_ready), verdict::degraded);
}

TEST(camera_check, says_why_it_is_not_ready) {
  auto seen = good_facts();
  seen.camera = {camera_state::not_ready, "there is no /dev/video0"};
  EXPECT_TRUE(has(check_camera(seen, {}).sentence, "there is no /dev/video0; "));
}

TEST(camera_check, fails_before_anything_was_heard_of_it) { EXPECT_EQ(with(camera_state::unknown), verdict::fail); }

TEST(camera_check, is_skipped_when_it_is_off) { EXPECT_EQ(with(camera_state::off), verdict::skipped); }

} // namespace camera_test
} // namespace godwit::executor::preflight
