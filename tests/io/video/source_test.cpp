#include <condition_variable>
#include <functional>
#include <mutex>

#include <gtest/gtest.h>

#include "io/video/source.hpp"
#include "tests/io/video/painted_frame.hpp"

namespace source_test {

using namespace godwit::io::video;
using namespace std::chrono_literals;

constexpr auto patience = 20s;

// A camera, and what it has said.
struct watched {
  explicit watched(const std::string& uri, const source_limits& limits = {}, bool takes = true, bool is_paced = true)
      : takes_all(takes), camera(
                              parse_camera_uri(uri).value(), limits, [this] { heard(); }, is_paced) {}

  void heard() {
    const std::lock_guard guard(mutex);
    ++calls;
    changed.notify_all();
  }
  // Looks again with each picture, and each 20 ms.
  bool wait_for(const std::function<bool()>& what) {
    const auto until = std::chrono::steady_clock::now() + patience;
    while (std::chrono::steady_clock::now() < until) {
      if (what())
        return true;
      std::unique_lock lock(mutex);
      changed.wait_for(lock, 20ms);
      lock.unlock();
      if (takes_all)
        if (const auto picture = camera.take()) {
          EXPECT_TRUE(!last || picture->captured_ns > last->captured_ns);
          last = picture;
          ++taken;
        }
    }
    return false;
  }
  bool takes_all;
  std::mutex mutex;
  std::condition_variable changed;
  int calls = 0;
  int taken = 0;
  std::optional<frame> last;
  source camera; // last: it calls from its beginning on
};

TEST(video_source, pictures_come_with_their_size_and_a_rising_time) {
  watched s("test://ball?width=320&height=240&fps=50");
  EXPECT_TRUE(s.wait_for([&] { return s.taken >= 20; }));
  EXPECT_EQ(s.last->width, 320);
  EXPECT_EQ(s.last->height, 240);
  const auto report = s.camera.report();
  EXPECT_EQ(report.state, source_state::playing);
  EXPECT_EQ(report.reason, "");
  EXPECT_EQ(report.opened, 1U);
}

TEST(video_source, the_newest_picture_wins_and_those_nobody_took_are_counted) {
  watched s("test://ball?fps=100", {}, false);
  EXPECT_TRUE(s.wait_for([&] { return s.calls >= 20; }));
  ASSERT_TRUE(s.camera.take());
  const auto report = s.camera.report();
  EXPECT_GE(report.dropped, 18U);
  EXPECT_GE(report.frames, report.dropped);
}

TEST(video_source, a_camera_that_is_not_there_is_named_with_the_remedy) {
  watched device("v4l2:///dev/video-none");
  EXPECT_TRUE(device.wait_for([&] { return device.camera.report().state == source_state::failed; }));
  EXPECT_NE(device.camera.report().reason.find("there is no /dev/video-none: connect the camera"), std::string::npos);
  watched file("file:///nowhere/at/all.mkv");
  EXPECT_TRUE(file.wait_for([&] { return file.camera.report().state == source_state::failed; }));
  EXPECT_NE(file.camera.report().reason.find("No such file"), std::string::npos);
  watched network("rtsp://127.0.0.1:9/camera");
  EXPECT_TRUE(network.wait_for([&] { return network.camera.report().state == source_state::failed; }));
  EXPECT_NE(network.camera.report().reason, "");
}

TEST(video_source, a_camera_that_ends_or_hangs_is_opened_again_and_plays_within_two_seconds) {
  for (const auto* vice : {"stop_after=10", "hang_after=10"}) {
    watched s("test://ball?fps=50&" + std::string(vice), {.silence_limit = 300ms});
    EXPECT_TRUE(s.wait_for([&] { return s.camera.report().state == source_state::failed; })) << vice;
    EXPECT_NE(s.camera.report().reason, "") << vice;
    const auto lost = std::chrono::steady_clock::now();
    EXPECT_TRUE(s.wait_for([&] { return s.camera.report().state == source_state::playing; })) << vice;
    EXPECT_LT(std::chrono::steady_clock::now() - lost, 2s) << vice;
    EXPECT_EQ(s.camera.report().opened, 2U) << vice;
    EXPECT_EQ(s.camera.report().reason, "") << vice;
  }
}

TEST(video_source, a_change_of_size_is_counted_and_the_pictures_go_on) {
  watched s("test://ball?fps=50&resize_after=10");
  EXPECT_TRUE(s.wait_for([&] { return s.last && s.last->width == 320; }));
  EXPECT_EQ(s.last->height, 180);
  EXPECT_EQ(s.camera.report().changes, 1U);
  EXPECT_EQ(s.camera.report().opened, 1U);
}

TEST(video_source, black_and_repeated_pictures_are_noticed) {
  watched black("test://black?fps=50");
  EXPECT_TRUE(black.wait_for([&] { return black.camera.report().fault == picture_fault::black; }));
  watched white("test://white?fps=50");
  EXPECT_TRUE(white.wait_for([&] { return white.camera.report().fault == picture_fault::repeated; }));
  watched sound("test://snow?fps=50");
  EXPECT_TRUE(sound.wait_for([&] { return sound.taken >= 60; }));
  EXPECT_EQ(sound.camera.report().fault, picture_fault::none);
}

} // namespace source_test

namespace picture_watch_test {

using namespace godwit::io::video;

constexpr std::int64_t tenth = 100'000'000;

picture_fault after(picture_watch& watch, int first, int last, std::uint8_t brightness, int step) {
  auto result = picture_fault::none;
  for (int i = first; i <= last; ++i)
    result = watch.look(painted_frame(64, 48, static_cast<std::uint8_t>(brightness + i * step), i * tenth));
  return result;
}

TEST(picture_watch, a_second_of_the_same_picture_is_a_fault_and_another_one_ends_it) {
  picture_watch watch;
  EXPECT_EQ(after(watch, 1, 10, 90, 0), picture_fault::none);
  EXPECT_EQ(after(watch, 11, 11, 90, 0), picture_fault::repeated);
  EXPECT_EQ(after(watch, 12, 12, 91, 0), picture_fault::none);
}

TEST(picture_watch, a_second_of_black_is_a_fault_also_where_it_changes) {
  picture_watch watch;
  EXPECT_EQ(after(watch, 1, 1, 90, 0), picture_fault::none);
  EXPECT_EQ(after(watch, 2, 10, 5, 1), picture_fault::none);
  EXPECT_EQ(after(watch, 11, 11, 5, 1), picture_fault::black);
  EXPECT_EQ(after(watch, 12, 12, 90, 0), picture_fault::none);
}

TEST(picture_watch, pictures_of_any_size_are_taken) {
  picture_watch watch;
  EXPECT_EQ(watch.look(painted_frame(1, 1, 90, 1)), picture_fault::none);
  EXPECT_EQ(watch.look(painted_frame(1280, 720, 90, 2)), picture_fault::none);
}

} // namespace picture_watch_test
