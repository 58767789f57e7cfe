#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace operator_session_test {

using namespace test;

verdict with(bool is_required, bool is_alive) {
  auto seen = good_facts();
  seen.is_operator_session_alive = is_alive;
  return check_operator_session(seen, {.is_operator_session_required = is_required}).how;
}

TEST(operator_session_check, passes_when_one_is_required_and_alive) { EXPECT_EQ(with(true, true), verdict::pass); }

TEST(operator_session_check, fails_when_one_is_required_and_not_alive) { EXPECT_EQ(with(true, false), verdict::fail); }

TEST(operator_session_check, is_skipped_when_none_is_required) {
  EXPECT_EQ(with(false, false), verdict::skipped);
  EXPECT_EQ(with(false, true), verdict::skipped);
}

} // namespace operator_session_test
} // namespace godwit::executor::preflight
