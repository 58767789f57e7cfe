#include <gtest/gtest.h>

#include "io/link/lifecycle.hpp"

namespace godwit::io::link {

namespace lifecycle_test {

using namespace std::chrono_literals;

struct lifecycle_test : ::testing::Test {
  // What the next tries come to: an empty text opens.
  void open() {
    ++tries;
    if (outcome.empty())
      life.opened("there");
    else
      life.failed(outcome);
  }
  void run_until(const std::function<bool()>& what) {
    io.restart(); // it has stopped when it had nothing to do
    while (!what() && io.run_one_for(30s) != 0) {
    }
    ASSERT_TRUE(what());
  }

  boost::asio::io_context io;
  counter_set counters;
  std::vector<link_status> told;
  std::string outcome;
  int tries = 0;
  lifecycle life{
      io, {1ms, 2ms}, counters, [this](const link_status& status) { told.push_back(status); }, [this] { open(); }};
};

TEST_F(lifecycle_test, first_it_connects_and_then_it_is_up) {
  life.begin("trying");
  EXPECT_EQ(told, (std::vector<link_status>{{link_phase::connecting, "trying", 0}, {link_phase::up, "there", 0}}));
}

TEST_F(lifecycle_test, a_failure_that_repeats_itself_is_told_once_and_counted_each_time) {
  outcome = "no such device";
  life.begin("trying");
  run_until([&] { return tries == 5; });
  EXPECT_EQ(told.size(), 2U);
  EXPECT_EQ(told.back(), (link_status{link_phase::down, "no such device", 0}));
  EXPECT_EQ(counters.open_failures.value(), 5U);
  EXPECT_EQ(counters.losses.value(), 0U);
}

TEST_F(lifecycle_test, a_new_reason_is_told) {
  outcome = "no such device";
  life.begin("trying");
  outcome = "permission denied";
  run_until([&] { return tries == 2; });
  EXPECT_EQ(told.back().reason, "permission denied");
}

TEST_F(lifecycle_test, coming_back_after_a_loss_counts_as_a_reconnect_and_coming_up_first_does_not) {
  outcome = "no such device";
  life.begin("trying");
  outcome.clear();
  run_until([&] { return life.phase() == link_phase::up; });
  EXPECT_EQ(told.back().reconnects, 0U);
  life.failed("went away");
  EXPECT_EQ(told.back(), (link_status{link_phase::down, "went away", 0}));
  run_until([&] { return life.phase() == link_phase::up; });
  EXPECT_EQ(told.back().reconnects, 1U);
  EXPECT_EQ(counters.losses.value(), 1U);
  EXPECT_EQ(counters.open_failures.value(), 1U);
}

TEST_F(lifecycle_test, a_peer_that_does_not_answer_is_down_without_a_new_try) {
  life.begin("trying");
  life.unanswered("refused");
  EXPECT_EQ(life.phase(), link_phase::down);
  EXPECT_EQ(io.poll(), 0U) << "nothing is scheduled";
  life.answered("there");
  EXPECT_EQ(told.back(), (link_status{link_phase::up, "there", 1}));
  EXPECT_EQ(tries, 1);
}

} // namespace lifecycle_test

namespace back_off_test {

using std::chrono::milliseconds;

TEST(link_back_off, each_wait_is_twice_the_last_one_up_to_the_cap) {
  back_off pause(milliseconds(100), milliseconds(1000));
  for (const int expected_ms : {100, 200, 400, 800, 1000, 1000})
    EXPECT_EQ(pause.next(), milliseconds(expected_ms));
}

TEST(link_back_off, it_starts_anew_when_told) {
  back_off pause(milliseconds(100), milliseconds(1000));
  static_cast<void>(pause.next());
  static_cast<void>(pause.next());
  pause.reset();
  EXPECT_EQ(pause.next(), milliseconds(100));
}

} // namespace back_off_test

} // namespace godwit::io::link
