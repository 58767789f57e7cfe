// A day without a broker: what the journal takes of the disk, and how long it takes to tell all of it over a slow line
// while what is live stays young. The journal is a real file; the day passes in virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "actors/fleet_link/actor.hpp"
#include "actors/fleet_link/news.hpp"
#include "runtime/address/mail_view.hpp"
#include "runtime/process.hpp"
#include "tests/actors/fleet_link/fleet_world.hpp"

namespace godwit::fleet_link {
namespace day_test {

using namespace godwit::tests;
using namespace std::chrono_literals;
using json = nlohmann::json;

constexpr std::uint32_t events_a_day = 24 * 3600 / 3; // one each 3 s
constexpr std::uint64_t max_disk_bytes = std::uint64_t{64} << 20U;

class no_broker final : public broker_port {
public:
  void open(std::uint64_t, const publication&) override {}
  void close(std::uint64_t) override {}
  void publish(std::uint64_t, const publication&) override {}
};

executor::flight_status flight_at(std::uint32_t items_done) {
  executor::flight_status result;
  result.phase = "flying";
  result.sentence = "the mission is flown";
  result.mission_id = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";
  result.items = events_a_day;
  result.items_done = items_done;
  return result;
}

std::uint64_t bytes_in(const std::filesystem::path& folder) {
  std::uint64_t result = 0;
  for (const auto& each : std::filesystem::directory_iterator(folder))
    result += each.file_size();
  return result;
}

// A process whose actor has no broker. SAY(n) is told as the n-th thing.
class lonely_vehicle {
public:
  lonely_vehicle() {
    std::string name = (std::filesystem::temp_directory_path() / "godwit_day_XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    options_.journal.path = (folder_ / "godwit.db").string();
  }
  lonely_vehicle(const lonely_vehicle&) = delete;
  lonely_vehicle& operator=(const lonely_vehicle&) = delete;
  ~lonely_vehicle() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  // The most that all files took at any time.
  template <class Say>
  std::uint64_t live(std::uint32_t count, const Say& say) {
    auto host = std::move(*runtime::process::open(options_));
    const auto others = std::make_shared<peers>();
    others->say = [](const std::string&, bool) {};
    const own_handle fleet =
        host->actors().add<actor>({.name = "fleet_link"}, {}, fleet_settings(), std::shared_ptr<const peers>(others),
                                  std::make_shared<no_broker>(), std::uint64_t{1});
    host->actors().start();
    auto way_in = host->actors().make_gateway("test");
    std::uint64_t most = 0;
    for (std::uint32_t i = 1; i <= count; ++i) {
      way_in.tell(fleet, say(i));
      if (i % 500 == 0) {
        wait_until_heard(*host, i);
        EXPECT_TRUE(host->journal().flush(60s));
        most = std::max(most, bytes_in(folder_));
      }
    }
    wait_until_heard(*host, count);
    static_cast<void>(host->finish(0));
    return std::max(most, bytes_in(folder_));
  }
  // As the next process finds it.
  state restored() {
    auto host = std::move(*runtime::process::open(options_));
    std::promise<runtime::recovered> read;
    host->journal().recover("fleet_link", 9, [&](auto found) { read.set_value(*std::move(found)); });
    const auto found = read.get_future().get();
    auto result = runtime::read_state<durable_core>("fleet_link", *found.snapshot);
    for (const auto& each : found.events)
      (void)durable_core::apply(
          result, runtime::read_alternative<durable_core::event>("fleet_link", each.type, each.body), each.at_ns);
    static_cast<void>(host->finish(0));
    return result;
  }

private:
  static void wait_until_heard(runtime::process& host, std::uint64_t count) {
    const auto heard = [&] {
      const auto all = runtime::look_at_mail(host.actors());
      return std::ranges::any_of(all, [&](const auto& each) {
        return each.actor == "fleet_link" && each.waiting == 0 && each.counted.handled >= count;
      });
    };
    for (int looks = 0; looks < 60'000 && !heard(); ++looks)
      std::this_thread::sleep_for(1ms);
  }

  std::filesystem::path folder_;
  runtime::process_options options_;
};

TEST(fleet_link_day, a_day_without_a_broker_takes_at_most_64_MB_of_the_disk_and_loses_nothing) {
  lonely_vehicle rover;
  const auto most = rover.live(events_a_day, flight_at);
  std::printf("%u events: at most %.1f MiB on the disk\n", events_a_day, static_cast<double>(most) / (1U << 20U));
  EXPECT_LE(most, max_disk_bytes);
  const auto s = rover.restored();
  EXPECT_GE(s.events.size(), events_a_day);
  EXPECT_EQ(s.dropped, 0U);
}

TEST(fleet_link_day, large_events_take_no_more_the_oldest_are_dropped_and_counted) {
  lonely_vehicle rover;
  constexpr std::uint32_t count = 5'000;
  const auto most = rover.live(count, [](std::uint32_t i) {
    health::health_status result;
    result.worst = i % 2 == 0 ? health::colour::green : health::colour::yellow;
    result.parts.push_back({"journal", health::colour::yellow, std::string(2'000, '"'), 0});
    return result;
  });
  std::printf("%u events: at most %.1f MiB on the disk\n", count, static_cast<double>(most) / (1U << 20U));
  EXPECT_LE(most, max_disk_bytes);
  const auto s = rover.restored();
  EXPECT_LE(s.event_bytes, max_event_bytes);
  EXPECT_GT(s.dropped, 0U);
  EXPECT_EQ(s.dropped + s.events.size(), count + 1) << "and that the process began";
}

// 1 Mbit/s, 100 ms there and back.
TEST(fleet_link_day, is_told_within_five_minutes_over_a_slow_line_and_what_is_live_is_no_older_than_a_second) {
  constexpr std::int64_t bytes_a_second = 125'000;
  constexpr std::int64_t one_way_ns = 50'000'000;
  constexpr std::int64_t step_ns = 5'000'000;
  fleet_world world;
  for (std::uint32_t i = 1; i <= events_a_day; ++i) {
    const auto made = news_of(sight{}, flight_at(i));
    for (const auto& each : made->what)
      if (each.kind == event_kind::progress)
        world.apply(noted{{each}, true, {}});
  }
  world.sync();
  world.turn();
  world.accept();
  const auto began_ns = world.now_ns;
  std::int64_t oldest_ns = 0;
  std::int64_t free_ns = 0; // the line
  std::deque<std::pair<std::int64_t, publication>> arriving;
  std::deque<std::pair<std::int64_t, std::uint64_t>> acknowledged;
  std::int64_t next_position_ns = world.now_ns;
  std::int64_t next_beat_ns = world.now_ns;
  while (!world.state.events.empty() && world.now_ns - began_ns < 1'000 * fleet_second) {
    world.now_ns += step_ns;
    if (world.now_ns >= next_position_ns) {
      world.core.on_text(std::make_shared<const std::string>(R"({"topic":"position","at_ns":)" +
                                                             std::to_string(world.now_ns) + R"(,"pad":")" +
                                                             std::string(250, 'x') + R"("})"));
      next_position_ns += fleet_second / 10;
    }
    bool has_news = world.now_ns >= next_beat_ns;
    for (; !acknowledged.empty() && acknowledged.front().first <= world.now_ns; acknowledged.pop_front()) {
      has_news = true;
      if (acknowledged.front().second != 0)
        world.core.on_taken({*world.attempt, acknowledged.front().second});
    }
    if (has_news) {
      world.turn();
      next_beat_ns = world.now_ns + core::beat_ns;
    }
    while (!world.on_the_way.empty()) {
      auto what = std::move(world.on_the_way.front());
      world.on_the_way.pop_front();
      const auto size = static_cast<std::int64_t>(what.payload->size() + what.topic.size() + 60);
      free_ns = std::max(free_ns, world.now_ns) + size * fleet_second / bytes_a_second;
      if (what.number == 0)
        world.core.on_left({*world.attempt});
      arriving.emplace_back(free_ns + one_way_ns, std::move(what));
    }
    for (; !arriving.empty() && arriving.front().first <= world.now_ns; arriving.pop_front()) {
      const auto& what = arriving.front().second;
      if (what.how == publication::kind::event)
        acknowledged.emplace_back(world.now_ns + one_way_ns, what.number);
      else if (what.how == publication::kind::live)
        oldest_ns = std::max(oldest_ns, world.now_ns - json::parse(*what.payload).at("at_ns").get<std::int64_t>());
    }
  }
  const auto took_s = static_cast<double>(world.now_ns - began_ns) / 1e9;
  std::printf("%u events in %.0f s, what is live at most %.2f s old\n", events_a_day, took_s,
              static_cast<double>(oldest_ns) / 1e9);
  EXPECT_TRUE(world.state.events.empty());
  EXPECT_LE(took_s, 300);
  EXPECT_LE(oldest_ns, fleet_second);
  EXPECT_GT(oldest_ns, 0);
}

} // namespace day_test
} // namespace godwit::fleet_link
