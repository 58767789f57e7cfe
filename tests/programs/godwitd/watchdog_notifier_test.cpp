#include "programs/godwitd/watchdog_notifier.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/programs/godwitd/notify_listener.hpp"
#include "tests/programs/godwitd/scratch.hpp"

namespace watchdog_notifier_test {

using namespace godwit;
using namespace godwit::daemon;
using namespace std::chrono_literals;
using words = std::vector<std::string>;
using enum runtime::health_colour;

struct pulse_test : testing::Test {
  test::scratch folder;
  test::notify_listener listener{folder.file("notify")};
  service_manager manager = service_manager::at(folder.file("notify"), 500ms).value();
  bool has_begun = true;
  bool is_responsive = true;
  std::vector<runtime::health_entry> health;
  words news;
  watchdog_notifier beats{manager,
                          {[this] { return has_begun; }, [this] { return is_responsive; }, [this] { return health; },
                           [this](const health_change& each) { news.push_back(each.sentence); }},
                          "mission 7: "};
};

TEST_F(pulse_test, ready_is_said_once_and_only_when_all_actors_have_been_up) {
  has_begun = false;
  beats.beat();
  EXPECT_EQ(listener.take_all(), words{"WATCHDOG=1"});
  has_begun = true;
  beats.beat();
  EXPECT_EQ(listener.take_all(), (words{"READY=1", "STATUS=mission 7: all is well", "WATCHDOG=1"}));
  beats.beat();
  EXPECT_EQ(listener.take_all(), words{"WATCHDOG=1"});
}

TEST_F(pulse_test, actors_that_do_not_answer_are_not_called_alive) {
  beats.beat();
  (void)listener.take_all();
  is_responsive = false;
  beats.beat();
  EXPECT_TRUE(listener.take_all().empty());
}

TEST_F(pulse_test, health_is_told_when_it_changes) {
  health = {{"journal", red, "disk full"}};
  beats.beat();
  beats.beat();
  health = {};
  beats.beat();
  health = {{"journal", green, ""}};
  beats.beat();
  EXPECT_EQ(news, words{"journal is red: disk full"}) << "a part that is not on the board any more says nothing";
  EXPECT_EQ(listener.take_all(), (words{"READY=1", "STATUS=mission 7: red: journal: disk full", "WATCHDOG=1",
                                        "WATCHDOG=1", "STATUS=mission 7: all is well", "WATCHDOG=1", "WATCHDOG=1"}));
}

TEST_F(pulse_test, a_reload_stands_between_reloading_and_ready_once_it_is_ready) {
  int reloads = 0;
  beats.around_reload([&] { ++reloads; });
  EXPECT_TRUE(listener.take_all().empty());
  beats.beat();
  (void)listener.take_all();
  beats.around_reload([&] { ++reloads; });
  const auto heard = listener.take_all();
  ASSERT_EQ(heard.size(), 2U);
  EXPECT_TRUE(heard[0].starts_with("RELOADING=1\n"));
  EXPECT_EQ(heard[1], "READY=1");
  EXPECT_EQ(reloads, 2);
  beats.end();
  beats.around_reload([&] { ++reloads; });
  EXPECT_TRUE(listener.take_all().empty());
}

TEST_F(pulse_test, it_beats_at_least_twice_in_the_watchdogs_period) {
  EXPECT_EQ(beats.period(), 250ms);
  const service_manager patient = service_manager::at(folder.file("notify"), 60s).value();
  EXPECT_EQ(watchdog_notifier(patient, {}, "").period(), 1s);
  EXPECT_EQ(watchdog_notifier(service_manager(), {}, "").period(), 1s);
}

TEST_F(pulse_test, started_it_beats_by_itself_until_it_is_ended) {
  beats.start();
  const auto end = std::chrono::steady_clock::now() + 60s;
  words heard;
  while (std::ranges::count(heard, "WATCHDOG=1") < 3 && std::chrono::steady_clock::now() < end) {
    for (auto& each : listener.take_all())
      heard.push_back(std::move(each));
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_GE(std::ranges::count(heard, "WATCHDOG=1"), 3);
  EXPECT_EQ(std::ranges::count(heard, "READY=1"), 1);
  beats.end();
}

} // namespace watchdog_notifier_test
