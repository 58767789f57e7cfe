#include "io/video/recorder.hpp"

#include <filesystem>
#include <fstream>
#include <thread>

#include <csignal>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/video/jpeg_encoder.hpp"
#include "io/video/source.hpp"
#include "tests/io/video/painted_frame.hpp"
#include "tests/support/time_units.hpp"

namespace recorder_test {

using namespace godwit::io::video;
using namespace std::chrono_literals;
namespace fs = std::filesystem;

using godwit::tests::ms;

struct recording {
  recording() { fs::remove_all(folder); }
  ~recording() { fs::remove_all(folder); }

  void add(recorder& to, int first, int last, int width = 320) {
    jpeg_encoder encoder(60);
    for (int i = first; i <= last; ++i)
      to.add(encoder.encode(painted_frame(width, 240, static_cast<std::uint8_t>(40 + i % 150), i)).value(), i * 50 * ms,
             width, 240);
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> result;
    for (const auto& each : fs::directory_iterator(folder))
      result.push_back(each.path());
    std::ranges::sort(result);
    return result;
  }
  // How many pictures a reader finds.
  static std::uint64_t pictures_in(const fs::path& file) {
    source reader(
        parse_camera_uri("file://" + file.string()).value(), {}, [] {}, false);
    const auto until = std::chrono::steady_clock::now() + 20s;
    std::uint64_t result = 0;
    bool is_over = false;
    while (!is_over && std::chrono::steady_clock::now() < until) {
      is_over = reader.report().state == source_state::ended || reader.report().state == source_state::failed;
      while (reader.take())
        ++result;
      std::this_thread::yield();
    }
    return result;
  }
  std::string folder = fs::temp_directory_path() / ("godwit_recorder_" + std::to_string(::getpid()));
};

TEST(video_recorder, what_was_recorded_is_read_again_picture_by_picture) {
  recording s;
  {
    recorder to({s.folder, 100'000'000});
    s.add(to, 0, 39);
    EXPECT_EQ(to.report().error, "");
  }
  ASSERT_EQ(s.files().size(), 1U);
  EXPECT_EQ(s.pictures_in(s.files()[0]), 40U);
}

TEST(video_recorder, a_segment_ends_after_its_time_and_with_a_change_of_size) {
  recording s;
  {
    recorder to({s.folder, 100'000'000, 1s});
    s.add(to, 0, 39);       // two seconds
    s.add(to, 40, 45, 160); // another size
    EXPECT_EQ(to.report().segments, 3U);
  }
  ASSERT_EQ(s.files().size(), 3U);
  EXPECT_EQ(s.pictures_in(s.files()[1]), 20U);
}

TEST(video_recorder, the_oldest_segments_are_deleted_above_the_bound_and_no_other_file_is) {
  recording s;
  fs::create_directories(s.folder);
  std::ofstream(s.folder + "/notes.txt") << "keep";
  {
    recorder to({s.folder, 30'000, 1s});
    s.add(to, 0, 399);
  }
  EXPECT_TRUE(fs::exists(s.folder + "/notes.txt"));
  std::uintmax_t sum = 0;
  for (const auto& each : s.files())
    sum += fs::file_size(each);
  EXPECT_LT(sum, 30'000U + 60'000U) << "the bound, and the segment that was written last";
  EXPECT_LT(s.files().size(), 15U);
}

TEST(video_recorder, what_a_killed_process_has_recorded_is_read_up_to_its_last_second) {
  recording s;
  int ready[2];
  ASSERT_EQ(::pipe2(ready, O_CLOEXEC), 0);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, ready[1], STDOUT_FILENO);
  std::string name = GODWIT_RECORDING_VICTIM;
  char* const arguments[] = {name.data(), s.folder.data(), nullptr};
  pid_t child = 0;
  ASSERT_EQ(::posix_spawn(&child, name.c_str(), &actions, nullptr, arguments, environ), 0);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(ready[1]);
  char x = 0;
  EXPECT_EQ(::read(ready[0], &x, 1), 1);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  ::close(ready[0]);
  ASSERT_EQ(s.files().size(), 1U);
  EXPECT_GE(s.pictures_in(s.files()[0]), 80U);
}

TEST(video_recorder, a_folder_that_can_not_be_written_is_said_and_stops_nobody) {
  recording s;
  recorder to({"/proc/nowhere", 1'000'000});
  s.add(to, 0, 50);
  EXPECT_NE(to.report().error.find("/proc/nowhere"), std::string::npos);
}

} // namespace recorder_test
