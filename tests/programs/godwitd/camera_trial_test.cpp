#include "programs/godwitd/camera_trial.hpp"

#include <gtest/gtest.h>

#include "tests/support/time_units.hpp"

namespace camera_trial_test {

using namespace godwit;
using namespace godwit::daemon;
using executor::preflight::camera_state;
using tests::s;

// A trial on the ground whose helper only counts.
struct tried {
  tried() { all.set_in_flight(false); }
  camera_state look() { return all.look(now_ns).state; }
  void says(std::uint64_t frames, const std::string& reason = {}) {
    io::eyes::status said;
    said.frames = said.looked = frames;
    said.reason = reason;
    all.on_message(started, said);
  }
  [[nodiscard]] bool is_open() const { return started > ended; }
  std::uint32_t started = 0;
  std::uint32_t ended = 0;
  std::int64_t now_ns = 0;
  camera_trial all{{[this](std::uint32_t run) { started = run; }, [this](std::uint32_t upto) { ended = upto; }}};
};

TEST(camera_trial, a_camera_is_ready_when_a_picture_came_and_is_let_go_then) {
  tried t;
  EXPECT_EQ(t.look(), camera_state::unknown);
  EXPECT_TRUE(t.is_open());
  t.says(0);
  EXPECT_EQ(t.look(), camera_state::unknown);
  t.says(1);
  EXPECT_EQ(t.look(), camera_state::ready);
  EXPECT_FALSE(t.is_open());
}

TEST(camera_trial, one_that_gives_no_picture_is_named_with_the_reason_and_tried_on) {
  tried t;
  (void)t.look();
  t.says(0, "there is no /dev/video0");
  t.now_ns = camera_trial::patience_ns;
  EXPECT_EQ(t.look(), camera_state::not_ready);
  EXPECT_EQ(t.all.look(t.now_ns).problem, "there is no /dev/video0");
  EXPECT_TRUE(t.is_open()) << "it may be connected yet";
  t.says(1);
  EXPECT_EQ(t.look(), camera_state::ready);
}

TEST(camera_trial, a_model_that_can_not_be_used_and_pictures_that_are_not_looked_at_are_named) {
  tried t;
  (void)t.look();
  io::eyes::status said;
  said.frames = 1;
  t.all.on_message(t.started, said);
  EXPECT_EQ(t.look(), camera_state::unknown) << "its model is being loaded";
  t.now_ns = camera_trial::patience_ns;
  EXPECT_EQ(t.look(), camera_state::not_ready);
  EXPECT_EQ(t.all.look(t.now_ns).problem, "pictures come, and godwit-eyes does not look at them");
  said.looked = 1;
  said.model_error = "the model is not used: it is no net";
  t.all.on_message(t.started, said);
  EXPECT_EQ(t.look(), camera_state::not_ready);
  EXPECT_EQ(t.all.look(t.now_ns).problem, said.model_error);
  EXPECT_FALSE(t.is_open());
}

TEST(camera_trial, a_helper_that_ends_or_says_nothing_is_named_and_started_again) {
  tried t;
  (void)t.look();
  t.all.on_end(t.started, "it was ended by signal 9");
  EXPECT_EQ(t.look(), camera_state::not_ready);
  EXPECT_NE(t.all.look(t.now_ns).problem.find("signal 9"), std::string::npos);
  EXPECT_EQ(t.started, 1U);
  t.now_ns += camera_trial::retry_ns;
  (void)t.look();
  EXPECT_EQ(t.started, 2U);
  t.now_ns += camera_trial::patience_ns;
  EXPECT_NE(t.all.look(t.now_ns).problem.find("sent nothing"), std::string::npos);
  EXPECT_FALSE(t.is_open());
}

TEST(camera_trial, a_ready_camera_is_tried_again_after_a_minute) {
  tried t;
  (void)t.look();
  t.says(1);
  (void)t.look();
  t.now_ns = camera_trial::ready_lasts_ns - 1;
  (void)t.look();
  EXPECT_FALSE(t.is_open());
  t.now_ns += 1;
  EXPECT_EQ(t.look(), camera_state::ready) << "the last word holds while it is tried";
  EXPECT_TRUE(t.is_open());
}

TEST(camera_trial, in_flight_nothing_is_tried_and_what_is_open_is_let_go) {
  tried t;
  (void)t.look();
  t.all.set_in_flight(true);
  EXPECT_FALSE(t.is_open());
  t.now_ns = 100 * s;
  (void)t.look();
  EXPECT_FALSE(t.is_open());
  t.all.set_in_flight(false);
  (void)t.look();
  EXPECT_TRUE(t.is_open()) << "down again";
}

TEST(camera_trial, until_the_flight_is_known_to_be_over_nothing_is_tried) {
  std::uint32_t started = 0;
  camera_trial all({[&](std::uint32_t run) { started = run; }, [](std::uint32_t) {}});
  (void)all.look(0);
  EXPECT_EQ(started, 0U);
}

TEST(camera_trial, what_an_older_run_says_changes_nothing) {
  tried t;
  (void)t.look();
  t.all.on_end(t.started, "gone");
  (void)t.look();
  t.now_ns += camera_trial::retry_ns;
  (void)t.look();
  io::eyes::status old;
  old.frames = 5;
  t.all.on_message(1, old);
  EXPECT_EQ(t.look(), camera_state::not_ready);
}

} // namespace camera_trial_test
