#include "programs/godwitd/service_manager.hpp"

#include <cstdlib>

#include <gtest/gtest.h>

#include <unistd.h>

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
