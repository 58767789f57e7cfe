#include <gtest/gtest.h>

#include "runtime/supervision/child_list.hpp"

namespace ping_ledger_test {

using namespace godwit::runtime;
using namespace std::chrono_literals;
using indices = std::vector<std::size_t>;

constexpr std::int64_t at(milliseconds time) { return std::chrono::nanoseconds(time).count(); }

constexpr ping_policy limits{.period = 1s, .warn = 3s, .fatal = 10s};

using answer = ping_ledger::answer;

TEST(ping_ledger, a_child_that_is_not_watched_is_not_pinged) {
  ping_ledger ledger(limits, 2);
  const auto verdict = ledger.tick(at(1h));
  EXPECT_EQ(verdict.to_ping, indices{});
  EXPECT_EQ(verdict.late, indices{});
  EXPECT_EQ(verdict.silent, indices{});
}

TEST(ping_ledger, a_ping_goes_out_one_period_after_the_last_one) {
  ping_ledger ledger(limits, 2);
  ledger.watch(1, at(5s));
  EXPECT_EQ(ledger.tick(at(5'999ms)).to_ping, indices{});
  EXPECT_EQ(ledger.tick(at(6s)).to_ping, indices{1});
  EXPECT_EQ(ledger.tick(at(6'500ms)).to_ping, indices{}) << "the first is not answered yet";
  EXPECT_EQ(ledger.answered(1, ledger.key_of(1)), answer::in_time);
  EXPECT_EQ(ledger.tick(at(6'999ms)).to_ping, indices{});
  EXPECT_EQ(ledger.tick(at(7s)).to_ping, indices{1});
}

TEST(ping_ledger, each_ping_has_a_key_of_its_own) {
  ping_ledger ledger(limits, 2);
  ledger.watch(0, 0);
  ledger.watch(1, 0);
  EXPECT_EQ(ledger.tick(at(1s)).to_ping, (indices{0, 1}));
  const auto first = ledger.key_of(0);
  EXPECT_NE(first, ledger.key_of(1));
  EXPECT_EQ(ledger.answered(0, first), answer::in_time);
  EXPECT_EQ(ledger.tick(at(2s)).to_ping, indices{0});
  EXPECT_NE(first, ledger.key_of(0));
}

TEST(ping_ledger, a_late_answer_is_warned_of_once_and_ends_the_warning) {
  ping_ledger ledger(limits, 1);
  ledger.watch(0, 0);
  EXPECT_EQ(ledger.tick(at(1s)).to_ping, indices{0});
  EXPECT_EQ(ledger.tick(at(3'999ms)).late, indices{});
  EXPECT_EQ(ledger.tick(at(4s)).late, indices{0});
  EXPECT_EQ(ledger.tick(at(5s)).late, indices{});
  EXPECT_EQ(ledger.answered(0, ledger.key_of(0)), answer::late);
  EXPECT_EQ(ledger.answered(0, ledger.key_of(0)), answer::stale) << "an answer counts once";
  EXPECT_EQ(ledger.tick(at(5s)).to_ping, indices{0});
  EXPECT_EQ(ledger.tick(at(8s)).late, indices{0}) << "the next ping can be late again";
}

TEST(ping_ledger, a_silent_child_is_told_once_and_not_watched_any_more) {
  ping_ledger ledger(limits, 1);
  ledger.watch(0, 0);
  EXPECT_EQ(ledger.tick(at(1s)).to_ping, indices{0});
  EXPECT_EQ(ledger.tick(at(10'999ms)).silent, indices{});
  EXPECT_EQ(ledger.tick(at(11s)).silent, indices{0});
  const auto later = ledger.tick(at(1h));
  EXPECT_EQ(later.silent, indices{});
  EXPECT_EQ(later.to_ping, indices{});
}

TEST(ping_ledger, an_answer_with_an_old_key_is_ignored) {
  ping_ledger ledger(limits, 1);
  ledger.watch(0, 0);
  EXPECT_EQ(ledger.tick(at(1s)).to_ping, indices{0});
  const auto old = ledger.key_of(0);
  EXPECT_EQ(ledger.answered(0, old), answer::in_time);
  EXPECT_EQ(ledger.tick(at(2s)).to_ping, indices{0});
  EXPECT_EQ(ledger.tick(at(5s)).late, indices{0});
  EXPECT_EQ(ledger.answered(0, old), answer::stale);
  EXPECT_EQ(ledger.tick(at(12s)).silent, indices{0});
}

TEST(ping_ledger, a_forgotten_child_owes_nothing) {
  ping_ledger ledger(limits, 1);
  ledger.watch(0, 0);
  EXPECT_EQ(ledger.tick(at(1s)).to_ping, indices{0});
  const auto key = ledger.key_of(0);
  ledger.forget(0);
  EXPECT_EQ(ledger.tick(at(11s)).silent, indices{});
  EXPECT_EQ(ledger.answered(0, key), answer::stale);
}

TEST(ping_ledger, a_child_watched_again_starts_with_a_clean_sheet) {
  ping_ledger ledger(limits, 1);
  ledger.watch(0, 0);
  EXPECT_EQ(ledger.tick(at(1s)).to_ping, indices{0});
  const auto of_the_dead = ledger.key_of(0);
  ledger.watch(0, at(9s));
  EXPECT_EQ(ledger.tick(at(9'999ms)).to_ping, indices{});
  EXPECT_EQ(ledger.tick(at(10s)).to_ping, indices{0});
  EXPECT_EQ(ledger.answered(0, of_the_dead), answer::stale);
  EXPECT_EQ(ledger.tick(at(11s)).silent, indices{}) << "the old ping does not count";
}

} // namespace ping_ledger_test
