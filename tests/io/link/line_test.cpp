#include "io/link/line.hpp"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>

#include "tests/io/link/far_ends.hpp"

namespace godwit::io::link {
namespace line_test {

using testing::udp_end;

constexpr std::chrono::seconds long_enough{30}; // for a machine under load

// Counts the calls, and waits for them.
class alarm_clock {
public:
  void ring() {
    const std::lock_guard guard(mutex_);
    ++rings_;
    rang_.notify_all();
  }
  [[nodiscard]] bool wait_for(int rings) {
    std::unique_lock guard(mutex_);
    return rang_.wait_for(guard, long_enough, [&] { return rings_ >= rings; });
  }

private:
  std::mutex mutex_;
  std::condition_variable rang_;
  int rings_ = 0;
};

TEST(line, what_comes_in_is_queued_and_whoever_takes_it_is_woken) {
  const udp_end far;
  alarm_clock clock;
  line near;
  ASSERT_TRUE(near.open(*parse_uri("udpout://127.0.0.1:" + std::to_string(far.port())), {}, [&] { clock.ring(); }));
  int rings = 0;
  const auto next = [&] {
    auto got = near.incoming().take();
    while (!got && clock.wait_for(++rings))
      got = near.incoming().take();
    return got;
  };
  for (auto phase = link_phase::connecting; phase != link_phase::up;) {
    const auto got = next();
    ASSERT_TRUE(got && std::holds_alternative<link_status>(*got)) << "for the status";
    phase = std::get<link_status>(*got).phase;
  }
  std::array<std::byte, 3> hello{};
  EXPECT_TRUE(near.send(hello, every_peer));
  ASSERT_TRUE(far.receive());
  far.send(far.last_sender(), "answer");
  const auto got = next();
  near.close();
  ASSERT_TRUE(got && std::holds_alternative<arrival>(*got));
  EXPECT_EQ(std::get<arrival>(*got).bytes.size(), 6U);
}

class notes final : public tap {
public:
  void received(peer_id, std::span<const std::byte> bytes, bool is_datagram) override {
    const std::lock_guard guard(mutex_);
    heard_ += is_datagram ? bytes.size() : 0;
  }
  void sent(std::span<const std::byte> frame) override {
    const std::lock_guard guard(mutex_);
    sent_ += frame.size();
  }
  [[nodiscard]] std::pair<std::size_t, std::size_t> sizes() {
    const std::lock_guard guard(mutex_);
    return {heard_, sent_};
  }

private:
  std::mutex mutex_;
  std::size_t heard_ = 0;
  std::size_t sent_ = 0;
};

TEST(line, a_tap_hears_what_came_in_and_what_the_link_took_and_nothing_that_it_did_not) {
  const udp_end far;
  alarm_clock clock;
  const auto tapped = std::make_shared<notes>();
  line near;
  near.set_tap(tapped);
  std::array<std::byte, 3> hello{};
  EXPECT_FALSE(near.send(hello, every_peer));
  ASSERT_TRUE(near.open(*parse_uri("udpout://127.0.0.1:" + std::to_string(far.port())), {}, [&] { clock.ring(); }));
  int rings = 0;
  while (!near.send(hello, every_peer)) {
    if (!near.incoming().take()) { // nothing left: the next change wakes
      ASSERT_TRUE(clock.wait_for(++rings));
    }
  }
  ASSERT_TRUE(far.receive());
  far.send(far.last_sender(), "answer");
  for (bool is_answered = false; !is_answered;) {
    const auto got = near.incoming().take();
    is_answered = got && std::holds_alternative<arrival>(*got);
    if (!got) {
      ASSERT_TRUE(clock.wait_for(++rings));
    }
  }
  near.close();
  EXPECT_EQ(tapped->sizes(), (std::pair<std::size_t, std::size_t>(6, 3)));
}

TEST(line, a_line_that_is_not_open_sends_nothing) {
  line closed;
  EXPECT_FALSE(closed.send({}, every_peer));
  EXPECT_EQ(closed.description(), "closed");
  EXPECT_EQ(closed.counters(), link_counters{});
  closed.close();
}

TEST(line, what_can_never_work_is_an_error) {
  line bad;
  uri nowhere;
  nowhere.which = uri::kind::serial;
  EXPECT_FALSE(bad.open(nowhere, {}, [] {}));
}

} // namespace line_test
} // namespace godwit::io::link
