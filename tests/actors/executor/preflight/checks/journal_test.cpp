#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace journal_test {

using namespace test;

verdict with(bool is_writable, bool is_sound) {
  auto seen = good_facts();
  seen.journal.is_writable = is_writable;
  seen.journal.is_sound = is_sound;
  return check_journal(seen, {}).how;
}

TEST(journal_check, passes_when_it_is_sound_and_can_be_written) { EXPECT_EQ(with(true, true), verdict::pass); }

TEST(journal_check, fails_when_it_can_not_be_written) { EXPECT_EQ(with(false, true), verdict::fail); }

TEST(journal_check, fails_when_it_is_damaged) { EXPECT_EQ(with(true, false), verdict::fail); }

TEST(journal_check, fails_while_what_waits_to_be_written_is_near_its_bound) {
  auto seen = good_facts();
  seen.journal.is_nearly_full = true;
  EXPECT_EQ(check_journal(seen, {}).how, verdict::fail);
}

} // namespace journal_test
} // namespace godwit::executor::preflight
