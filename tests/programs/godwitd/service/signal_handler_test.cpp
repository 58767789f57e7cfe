#include "programs/godwitd/service/signal_handler.hpp"

#include <atomic>
#include <chrono>
#include <csignal>
#include <future>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

namespace godwit::daemon {
namespace signal_handler_test {

constexpr std::chrono::seconds patience{60};

// Each in a process of its own, because the signals stay blocked.

TEST(signal_handler_death, a_hangup_and_a_stop_are_told_and_the_stop_by_its_name) {
  EXPECT_EXIT(
      {
        signal_handler handler;
        std::promise<std::string> stopped;
        std::promise<void> hung_up;
        handler.start([&](const std::string& name) { stopped.set_value(name); }, [&] { hung_up.set_value(); });
        ::kill(::getpid(), SIGHUP);
        const bool is_heard = hung_up.get_future().wait_for(patience) == std::future_status::ready;
        ::kill(::getpid(), SIGTERM);
        auto name = stopped.get_future();
        const bool is_told = name.wait_for(patience) == std::future_status::ready && name.get() == "SIGTERM";
        ::_exit(is_heard && is_told ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

TEST(signal_handler_death, of_a_storm_of_hangups_one_a_second_counts_and_what_came_meanwhile_is_not_lost) {
  EXPECT_EXIT(
      {
        signal_handler handler;
        std::atomic<int> seen = 0;
        handler.start([](const std::string&) {}, [&] { ++seen; });
        for (int n = 0; n < 1'500; ++n) {
          ::kill(::getpid(), SIGHUP);
          ::usleep(1'000);
        }
        const auto in_the_storm = seen.load();
        for (int waits = 0; waits < 600 && seen < 2; ++waits)
          ::usleep(100'000);
        ::_exit(in_the_storm >= 1 && seen >= 2 && seen <= 60 ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

TEST(signal_handler_death, a_second_stop_ends_the_process) {
  EXPECT_EXIT(
      {
        signal_handler handler;
        std::promise<void> never;
        handler.start([](const std::string&) { ::kill(::getpid(), SIGINT); });
        ::kill(::getpid(), SIGINT);
        never.get_future().wait_for(patience);
      },
      testing::KilledBySignal(SIGINT), "");
}

} // namespace signal_handler_test
} // namespace godwit::daemon
