#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>
#include <unistd.h>

#include "programs/godwitd/service/service_manager.hpp"
#include "tests/programs/godwitd/notify_listener.hpp"
#include "tests/programs/godwitd/scratch.hpp"

namespace service_manager_test {

using namespace godwit::daemon;
using godwit::test::notify_listener;
using godwit::test::scratch;
using words = std::vector<std::string>;
using namespace std::chrono_literals;

struct variables {
  ~variables() {
    for (const auto* each : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"})
      ::unsetenv(each);
  }
  static void set(const char* name, const std::string& value) { ::setenv(name, value.c_str(), 1); }
};

TEST(service_manager, what_it_hears_is_what_sd_notify_says) {
  const scratch folder;
  notify_listener listener(folder.file("notify"));
  const auto manager = service_manager::at(folder.file("notify"), {}).value();
  manager.tell_ready();
  manager.tell_status("all is\nwell");
  manager.tell_alive();
  manager.tell_stopping();
  EXPECT_EQ(listener.take_all(), (words{"READY=1", "STATUS=all is well", "WATCHDOG=1", "STOPPING=1"}));
  manager.tell_reloading();
  const auto reload = listener.take_all();
  ASSERT_EQ(reload.size(), 1U);
  EXPECT_TRUE(reload[0].starts_with("RELOADING=1\nMONOTONIC_USEC=")) << reload[0];
}

TEST(service_manager, a_name_with_an_at_lies_in_the_abstract_space) {
  const auto name = "@godwitd-test-" + std::to_string(::getpid());
  notify_listener listener(name);
  service_manager::at(name, {})->tell_ready();
  EXPECT_EQ(listener.take_all(), words{"READY=1"});
}

TEST(service_manager, a_long_status_is_cut_between_characters) {
  const scratch folder;
  notify_listener listener(folder.file("notify"));
  std::string text(service_manager::max_status - 1, 'x');
  service_manager::at(folder.file("notify"), {})->tell_status(text + "ä and more");
  EXPECT_EQ(listener.take_all(), words{"STATUS=" + text});
}

TEST(service_manager, a_manager_that_does_not_listen_holds_nobody_up) {
  const scratch folder;
  const auto manager = service_manager::at(folder.file("notify"), {}).value();
  manager.tell_ready(); // nobody has bound it
  notify_listener listener(folder.file("notify"));
  for (int n = 0; n < 10'000; ++n) // more than any queue of datagrams
    manager.tell_alive();
  EXPECT_FALSE(listener.take_all().empty());
}

TEST(service_manager, an_address_that_is_none_is_a_sentence) {
  for (const auto& each : {std::string("vsock:2:1234"), std::string("/"), "/" + std::string(200, 'x')}) {
    const auto refused = service_manager::at(each, {});
    ASSERT_FALSE(refused) << each;
    EXPECT_NE(refused.error().find("NOTIFY_SOCKET"), std::string::npos);
  }
}

TEST(service_manager, without_a_manager_nothing_is_said_and_nobody_watches) {
  const variables cleared_after;
  ::unsetenv("NOTIFY_SOCKET");
  const auto manager = service_manager::from_environment().value();
  manager.tell_ready();
  EXPECT_FALSE(manager.watchdog());
}

TEST(service_manager, the_watchdog_is_ours_only_if_this_process_is_meant) {
  const variables cleared_after;
  const scratch folder;
  variables::set("NOTIFY_SOCKET", folder.file("notify"));
  variables::set("WATCHDOG_USEC", "2000000");
  EXPECT_EQ(service_manager::from_environment()->watchdog(), 2s);
  variables::set("WATCHDOG_PID", std::to_string(::getpid()));
  EXPECT_EQ(service_manager::from_environment()->watchdog(), 2s);
  variables::set("WATCHDOG_PID", std::to_string(::getppid()));
  EXPECT_FALSE(service_manager::from_environment()->watchdog());
  ::unsetenv("WATCHDOG_PID");
  for (const auto* each : {"", "0", "soon", "-5", "12 s"}) {
    variables::set("WATCHDOG_USEC", each);
    EXPECT_FALSE(service_manager::from_environment()->watchdog()) << each;
  }
}

} // namespace service_manager_test

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

namespace health_text_test {

using namespace godwit::daemon;
using enum godwit::runtime::health_colour;

TEST(health_text, the_line_names_the_worst_and_counts_the_others) {
  EXPECT_EQ(health_in_a_line({}), "all is well");
  EXPECT_EQ(health_in_a_line({{"link", green, ""}}), "all is well");
  EXPECT_EQ(health_in_a_line({{"link", yellow, ""}}), "yellow: link");
  EXPECT_EQ(health_in_a_line({{"a", yellow, "slow"}, {"journal", red, "disk full"}, {"b", green, ""}}),
            "red: journal: disk full; and 1 more");
}

TEST(health_text, a_change_of_colour_and_another_cause_are_news_and_another_number_is_none) {
  EXPECT_TRUE(health_changes({}, {{"a", green, ""}}).empty());
  const auto ill = health_changes({}, {{"a", red, "x"}});
  ASSERT_EQ(ill.size(), 1U);
  EXPECT_EQ(ill[0].sentence, "a is red: x");
  EXPECT_EQ(health_changes({{"a", red, "x for 5 s"}}, {{"a", red, "x for 6 s"}}).size(), 0U) << "the same, longer";
  EXPECT_EQ(health_changes({{"a", red, "x"}}, {{"a", red, "y"}}).size(), 1U) << "another cause";
  const auto well = health_changes({{"a", red, "x"}}, {{"a", green, ""}});
  ASSERT_EQ(well.size(), 1U);
  EXPECT_EQ(well[0].sentence, "a is well again");
}

} // namespace health_text_test
