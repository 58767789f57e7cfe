// Many publishers on one mosquitto, as the vehicles of a fleet are: 200 of them, or as many as GODWIT_VEHICLES says
// (docs/performance.md). Real time, with wide margins.
#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "io/link/io_thread.hpp"
#include "io/mqtt/connection.hpp"
#include "tests/support/mosquitto.hpp"

namespace godwit::io::mqtt {
namespace many_publishers_test {

using namespace std::chrono_literals;
using clock = std::chrono::steady_clock;

constexpr std::size_t usual_vehicles = 200;
constexpr int rounds = 5;
constexpr std::size_t at_a_time = 100; // that open: the queue of a listening socket is short

struct counts {
  std::mutex mutex;
  std::condition_variable changed;
  std::size_t opened = 0;
  std::size_t acknowledged = 0;
  std::size_t closed = 0;
  std::string last_sentence;

  void add(std::size_t counts::*which) {
    const std::lock_guard guard(mutex);
    ++(this->*which);
    changed.notify_all();
  }
  bool wait_for(std::size_t counts::*which, std::size_t least) {
    std::unique_lock lock(mutex);
    return changed.wait_for(lock, 120s, [&] { return this->*which >= least || closed != 0; }) && closed == 0;
  }
};

std::unique_ptr<connection> vehicle(boost::asio::io_context& io, std::uint16_t port, std::size_t number, counts& to) {
  connection_settings settings;
  settings.broker = {false, "127.0.0.1", port};
  settings.client_id = "rover-" + std::to_string(number);
  const auto will = std::make_shared<const std::string>(R"({"state":"offline"})");
  return std::make_unique<connection>(io, settings,
                                      message{"gw/v1/" + settings.client_id + "/status", will, true, true, 0},
                                      listener{[&to](std::uint32_t) { to.add(&counts::opened); },
                                               [&to](failure, const std::string& why) {
                                                 to.last_sentence = why;
                                                 to.add(&counts::closed);
                                               },
                                               [&to](std::uint64_t) { to.add(&counts::acknowledged); }});
}

double seconds_since(clock::time_point begin) { return std::chrono::duration<double>(clock::now() - begin).count(); }

TEST(mqtt_many_publishers, each_is_connected_and_each_of_their_messages_is_acknowledged) {
  if (!tests::broker::is_installed())
    GTEST_SKIP() << "mosquitto is not installed";
  const char* const asked = std::getenv("GODWIT_VEHICLES");
  const std::size_t vehicles = asked == nullptr ? usual_vehicles : std::stoul(asked);
  rlimit files{};
  ::getrlimit(RLIMIT_NOFILE, &files);
  files.rlim_cur = std::min<rlim_t>(files.rlim_max, vehicles + 100);
  ::setrlimit(RLIMIT_NOFILE, &files); // the broker inherits it
  ASSERT_GE(files.rlim_cur, vehicles + 100) << "raise it: ulimit -n";
  tests::broker broker;
  counts seen;
  link::io_thread thread;
  thread.start();
  std::vector<std::unique_ptr<connection>> fleet;
  auto begin = clock::now();
  while (fleet.size() < vehicles) {
    for (std::size_t n = 0; n < at_a_time && fleet.size() < vehicles; ++n)
      fleet.push_back(vehicle(thread.context(), broker.port(), fleet.size(), seen));
    ASSERT_TRUE(seen.wait_for(&counts::opened, fleet.size())) << seen.last_sentence;
  }
  const auto connect_s = seconds_since(begin);
  begin = clock::now();
  const auto text = std::make_shared<const std::string>(300, ' ');
  for (int round = 1; round <= rounds; ++round) {
    for (std::size_t n = 0; n < vehicles; ++n)
      fleet[n]->publish({"gw/v1/rover-" + std::to_string(n) + "/event", text, true, false, 0}, 1);
    ASSERT_TRUE(seen.wait_for(&counts::acknowledged, vehicles * static_cast<std::size_t>(round))) << seen.last_sentence;
  }
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  std::printf("%zu vehicles: connected in %.1f s, %zu messages acknowledged in %.1f s, %ld kB resident\n", vehicles,
              connect_s, vehicles * rounds, seconds_since(begin), used.ru_maxrss);
  for (auto& each : fleet)
    each->end();
  for (auto& each : fleet)
    EXPECT_TRUE(each->wait_for_end(60s));
  EXPECT_EQ(seen.closed, 0U);
}

} // namespace many_publishers_test
} // namespace godwit::io::mqtt
