#include "io/eyes/helper.hpp"

#include <condition_variable>
#include <csignal>
#include <mutex>

#include <gtest/gtest.h>

namespace helper_test {

using namespace godwit::io::eyes;
using namespace std::chrono_literals;

struct heard {
  explicit heard(const std::string& vice) : heard(std::vector<std::string>{GODWIT_HELPER_VICTIM, vice}) {}
  explicit heard(std::vector<std::string> command) : who(helper::make(std::move(command)).value()) {
    who->attach({[this](std::uint32_t run, const message& said) {
                   const std::lock_guard guard(mutex);
                   reported_by[run].push_back(std::get<status>(said).reason);
                   changed.notify_all();
                 },
                 [this](std::uint32_t run, const std::string& why) {
                   const std::lock_guard guard(mutex);
                   ended[run] = why;
                   changed.notify_all();
                 }});
  }
  ~heard() { who.reset(); } // before what it calls
  bool wait_for(const std::function<bool()>& what) {
    std::unique_lock lock(mutex);
    return changed.wait_for(lock, 10s, what);
  }
  std::mutex mutex;
  std::condition_variable changed;
  std::map<std::uint32_t, std::vector<std::string>> reported_by;
  std::map<std::uint32_t, std::string> ended;
  std::shared_ptr<helper> who;
};

TEST(eyes_helper, it_is_told_how_to_begin_and_both_speak) {
  heard s("good");
  EXPECT_FALSE(s.who->send(pose{})) << "nothing runs";
  s.who->start(1, {});
  EXPECT_TRUE(s.wait_for([&] { return s.reported_by[1].size() == 1; }));
  EXPECT_TRUE(s.who->send(pose{}));
  EXPECT_TRUE(s.wait_for([&] { return s.reported_by[1].size() == 2; }));
  EXPECT_EQ(s.reported_by[1], (std::vector<std::string>{"0", "1"}));
  EXPECT_EQ(s.who->slot().read()->captured_ns, 5);
  EXPECT_TRUE(s.ended.empty());
}

TEST(eyes_helper, a_helper_that_ends_or_talks_garbage_is_told_once_with_the_reason) {
  for (const auto& [vice, reason] :
       {std::pair{"exit", "it ended with code 7"}, std::pair{"garbage", "can not be read"}}) {
    heard s(vice);
    s.who->start(3, {});
    EXPECT_TRUE(s.wait_for([&] { return s.ended.size() == 1; })) << vice;
    EXPECT_NE(s.ended[3].find(reason), std::string::npos) << s.ended[3];
  }
}

TEST(eyes_helper, a_program_that_is_not_there_is_told) {
  heard s(std::vector<std::string>{"/nowhere/godwit-eyes"});
  s.who->start(1, {});
  EXPECT_TRUE(s.wait_for([&] { return s.ended.size() == 1; }));
  EXPECT_NE(s.ended[1].find("/nowhere/godwit-eyes can not be started: No such file"), std::string::npos) << s.ended[1];
}

TEST(eyes_helper, a_new_run_replaces_one_that_hangs_and_nobody_hears_of_its_end) {
  heard s("silent");
  for (std::uint32_t run = 1; run <= 3; ++run)
    s.who->start(run, {});
  s.who->end(3);
  s.who->start(9, {});
  s.who.reset();
  EXPECT_TRUE(s.ended.empty());
}

TEST(eyes_helper, what_was_ended_is_started_again) {
  heard s("good");
  s.who->start(1, {});
  EXPECT_TRUE(s.wait_for([&] { return s.reported_by[1].size() == 1; }));
  s.who->end(1);
  s.who->start(2, {});
  EXPECT_TRUE(s.wait_for([&] { return s.reported_by[2].size() == 1; }));
  s.who->end(1); // of somebody who has not heard of it
  EXPECT_TRUE(s.who->send(pose{}));
  EXPECT_TRUE(s.wait_for([&] { return s.reported_by[2].size() == 2; }));
}

} // namespace helper_test
