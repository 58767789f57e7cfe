#include <chrono>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

#include "programs/godwit-eyes/detection/detector.hpp"
#include "programs/godwit-eyes/session/looker.hpp"
#include "programs/godwit-eyes/session/picture_maker.hpp"
#include "tests/support/eyes/generated_frame.hpp"
#include "tests/support/eyes/small_net.hpp"
#include "tests/support/eyes/suite.hpp"
#include "tests/support/time_units.hpp"

namespace looker_test {

using namespace godwit;
using namespace godwit::eyes;
using namespace std::chrono_literals;

constexpr std::int64_t frame_ns = 33'333'333;

// A looker that is shown one picture at a time, at its own pace, with what a session does with its candidates.
struct shown {
  bool look_at(io::video::frame next) {
    const auto before = who.report().looked;
    {
      const std::lock_guard guard(mutex);
      waiting = std::move(next);
    }
    who.wake();
    for (const auto until = std::chrono::steady_clock::now() + 20s; std::chrono::steady_clock::now() < until;) {
      if (who.report().looked > before)
        return true;
      std::this_thread::sleep_for(1ms);
    }
    return false;
  }
  void take_in(const io::eyes::candidates& seen, const io::video::frame& in) {
    cutouts.add(seen, in);
    for (const auto& each : seen.seen) {
      ++pictures_of[each.track];
      ++classes[each.looks_like];
      if (const auto made = slot.read_cutout(each.track)) {
        ++with_cutout;
        EXPECT_LE(made->captured_ns, seen.captured_ns);
        EXPECT_LT(seen.captured_ns - made->captured_ns, cutout_maker::gap_ns);
      }
    }
  }

  std::mutex mutex;
  std::optional<io::video::frame> waiting;
  int passed_on = 0;
  std::map<std::uint32_t, int> pictures_of;
  std::map<object_class, int> classes;
  int with_cutout = 0;
  io::eyes::picture_slot slot = io::eyes::picture_slot::make().value();
  cutout_maker cutouts{slot};
  explicit shown(looker::model asked = {}) : wanted(std::move(asked)) {}
  looker::model wanted;
  looker who{{},
             wanted,
             [this] {
               const std::lock_guard guard(mutex);
               return std::exchange(waiting, std::nullopt);
             },
             [this](const io::video::frame&) { ++passed_on; },
             [this](const io::eyes::candidates& seen, const io::video::frame& in) { take_in(seen, in); }};
};

TEST(eyes_looker, what_moves_is_said_with_the_picture_in_which_it_was_seen) {
  sim::camera::suite_options options;
  options.width = 640;
  options.height = 360;
  const sim::camera::suite_case flight(sim::camera::tuning_seed(6), sim::camera::tier::a, options);
  shown s;
  for (int n = 0; n < 45; ++n)
    ASSERT_TRUE(s.look_at(test::frame_of(flight.frame(n).seen, (n + 1) * frame_ns)));
  s.who.end();
  EXPECT_EQ(s.passed_on, 45);
  EXPECT_GT(s.who.report().usable, 30U);
  EXPECT_GT(s.pictures_of.size(), 3U);
  int said = 0;
  for (const auto& [track, pictures] : s.pictures_of)
    said += pictures;
  EXPECT_GT(s.with_cutout, 0.9 * said) << "of " << said;
}

TEST(eyes_looker, with_a_model_candidates_have_a_class_and_a_model_that_is_none_is_said) {
  sim::camera::suite_options options;
  options.width = 640;
  options.height = 360;
  const sim::camera::suite_case flight(sim::camera::tuning_seed(6), sim::camera::tier::a, options);
  shown s{test::small_net()};
  for (int n = 0; n < 45; ++n)
    ASSERT_TRUE(s.look_at(test::frame_of(flight.frame(n).seen, (n + 1) * frame_ns)));
  EXPECT_EQ(s.who.report().model_error, "");
  EXPECT_GT(s.classes[object_class::person], 0);
  for (const auto& wrong : {looker::model(test::small_net(3)), looker::model(tl::make_unexpected("it is not there"))}) {
    shown other{wrong};
    ASSERT_TRUE(other.look_at(test::frame_of(flight.frame(0).seen, frame_ns)));
    EXPECT_TRUE(other.who.report().model_error.starts_with("the model is not used: it "))
        << other.who.report().model_error;
  }
}

TEST(eyes_looker, a_change_of_size_makes_a_new_detector_and_one_that_can_not_be_is_said) {
  shown s;
  for (const int width : {320, 640, 40}) {
    sim::camera::picture even;
    even.width = width;
    even.height = 180;
    even.grey.assign(static_cast<std::size_t>(width) * 180, 90);
    ASSERT_TRUE(s.look_at(test::frame_of(std::move(even), width * frame_ns)));
    EXPECT_EQ(s.who.report().usable, 0U);
    EXPECT_EQ(s.who.report().unusable, sentence_of(width == 40 ? unusable::bad_frame : unusable::blank));
  }
}

} // namespace looker_test

namespace pose_history_test {

using namespace godwit;
using namespace godwit::eyes;
using godwit::tests::ms;

io::eyes::pose pose_at(std::int64_t at_ns) {
  io::eyes::pose result;
  result.at_ns = at_ns;
  result.height_m = static_cast<double>(at_ns) / ms;
  return result;
}

TEST(pose_history, a_picture_finds_the_pose_that_is_nearest_in_time) {
  pose_history all;
  EXPECT_FALSE(all.at(0));
  for (std::int64_t at = 1000; at <= 2000; at += 100)
    all.add(pose_at(at * ms));
  EXPECT_EQ(all.at(1240 * ms)->at_ns, 1200 * ms);
  EXPECT_EQ(all.at(1260 * ms)->at_ns, 1300 * ms);
  EXPECT_EQ(all.at(900 * ms)->at_ns, 1000 * ms);
  EXPECT_EQ(all.at(2100 * ms)->at_ns, 2000 * ms);
  EXPECT_EQ(all.at(2100 * ms)->height_m, 2000);
}

TEST(pose_history, a_pose_of_another_time_is_none) {
  pose_history all;
  all.add(pose_at(0));
  EXPECT_TRUE(all.at(pose_history::max_age_ns));
  EXPECT_FALSE(all.at(pose_history::max_age_ns + 1));
  EXPECT_FALSE(all.at(-pose_history::max_age_ns - 1));
}

TEST(pose_history, what_is_not_newer_is_left_out_and_the_oldest_is_forgotten) {
  pose_history all;
  all.add(pose_at(100 * ms));
  all.add(pose_at(50 * ms));
  EXPECT_EQ(all.at(0)->at_ns, 100 * ms);
  for (std::int64_t i = 0; i < 1000; ++i)
    all.add(pose_at((200 + i) * ms));
  EXPECT_EQ(all.at(200 * ms)->at_ns, (1200 - static_cast<std::int64_t>(pose_history::max_poses)) * ms);
}

} // namespace pose_history_test
