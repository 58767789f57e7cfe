// godwit-eyes as the daemon starts it.
#include <condition_variable>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>

#include <gtest/gtest.h>
#include <unistd.h>

#include "io/eyes/helper.hpp"
#include "tests/support/eyes/small_net.hpp"

namespace process_test {

using namespace godwit::io::eyes;
using namespace std::chrono_literals;

struct started {
  started() {
    who->attach({[this](std::uint32_t run, const message& said) {
                   const std::lock_guard guard(mutex);
                   if (const auto* now = std::get_if<status>(&said))
                     statuses[run] = *now;
                   changed.notify_all();
                 },
                 [this](std::uint32_t run, const std::string& why) {
                   const std::lock_guard guard(mutex);
                   ended[run] = why;
                   changed.notify_all();
                 }});
  }
  ~started() { who.reset(); }
  void start(std::uint32_t run, const std::string& model = {}) {
    begin how;
    how.model = model;
    how.uri = "test://snow?fps=30";
    who->start(run, how);
  }
  bool is_playing(std::uint32_t run) {
    std::unique_lock lock(mutex);
    return changed.wait_for(lock, 20s, [&] { return statuses[run].source == source_state::playing; });
  }
  // When it has looked, and what it says of its model then.
  std::string model_error(std::uint32_t run) {
    std::unique_lock lock(mutex);
    const auto has_looked = [&] { return statuses[run].looked > 2; };
    return changed.wait_for(lock, 20s, has_looked) ? statuses[run].model_error : "it has not looked: " + ended[run];
  }
  // The one child of ours that is a godwit-eyes.
  static pid_t process() {
    for (const auto& each : std::filesystem::directory_iterator("/proc")) {
      std::ifstream file(each.path() / "stat");
      pid_t number = 0;
      std::string name;
      std::string state;
      pid_t parent = 0;
      if (file >> number >> name >> state >> parent && parent == ::getpid() && name == "(godwit-eyes)" && state != "Z")
        return number;
    }
    return 0;
  }
  std::mutex mutex;
  std::condition_variable changed;
  std::map<std::uint32_t, status> statuses;
  std::map<std::uint32_t, std::string> ended;
  std::shared_ptr<helper> who = helper::make({GODWIT_EYES_PROGRAM, "session"}).value();
};

TEST(eyes_process, it_plays_is_killed_and_plays_again) {
  started s;
  s.start(1);
  ASSERT_TRUE(s.is_playing(1)) << s.ended[1];
  ASSERT_NE(s.process(), 0);
  ::kill(s.process(), SIGKILL);
  {
    std::unique_lock lock(s.mutex);
    ASSERT_TRUE(s.changed.wait_for(lock, 10s, [&] { return s.ended.contains(1); }));
    EXPECT_NE(s.ended[1].find("signal 9"), std::string::npos) << s.ended[1];
  }
  s.start(2);
  EXPECT_TRUE(s.is_playing(2)) << s.ended[2];
}

TEST(eyes_process, shut_in_it_uses_its_model_and_names_one_that_it_can_not_use) {
  const auto folder = std::filesystem::temp_directory_path() / ("godwit_model_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  started s;
  s.start(1, godwit::eyes::test::written(godwit::eyes::test::small_net(), folder / "net"));
  EXPECT_EQ(s.model_error(1), "");
  s.start(2, godwit::eyes::test::written({"[net]\nnonsense", "and more"}, folder / "broken"));
  EXPECT_TRUE(s.model_error(2).starts_with("the model is not used: OpenCV does not read it")) << s.model_error(2);
  s.start(3, folder / "none.weights");
  EXPECT_EQ(s.model_error(3),
            "the model is not used: " + (folder / "none.cfg").string() + " can not be read: No such file or directory");
  std::filesystem::remove_all(folder);
}

TEST(eyes_process, it_ends_when_the_daemon_does) {
  started s;
  s.start(1);
  ASSERT_TRUE(s.is_playing(1)) << s.ended[1];
  s.who->end(1);
  const auto until = std::chrono::steady_clock::now() + 10s;
  while (s.process() != 0 && std::chrono::steady_clock::now() < until)
    ::usleep(20'000);
  EXPECT_EQ(s.process(), 0);
}

} // namespace process_test
