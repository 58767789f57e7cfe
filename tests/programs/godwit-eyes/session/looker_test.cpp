#include "programs/godwit-eyes/session/looker.hpp"

#include <chrono>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

#include "programs/godwit-eyes/detection/detector.hpp"
#include "programs/godwit-eyes/session/cutout_maker.hpp"
#include "programs/godwit-sim/camera/suite.hpp"
#include "tests/support/eyes/generated_frame.hpp"

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
  int with_cutout = 0;
  io::eyes::picture_slot slot = io::eyes::picture_slot::make().value();
  cutout_maker cutouts{slot};
  looker who{{},
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
