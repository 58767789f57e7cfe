#include "actors/vehicle_link/first_call.hpp"

#include <gtest/gtest.h>

namespace godwit::vehicle_link {
namespace first_call_test {

TEST(first_call, is_quick_at_first_and_then_once_a_second) {
  first_call call;
  EXPECT_FALSE(call.is_due(0)) << "nobody is called before the line is open";
  call.begin(0);
  std::int64_t now_ns = 0;
  for (int i = 0; i < first_call::quick_calls; ++i) {
    ASSERT_TRUE(call.is_due(now_ns)) << i;
    call.called(now_ns);
    if (i + 1 < first_call::quick_calls)
      now_ns += first_call::quick_period_ns;
  }
  EXPECT_FALSE(call.is_due(now_ns + first_call::quick_period_ns));
  EXPECT_TRUE(call.is_due(now_ns + first_call::period_ns));
}

TEST(first_call, is_over_when_somebody_was_heard) {
  first_call call;
  call.begin(0);
  call.end();
  EXPECT_FALSE(call.is_due(first_call::period_ns));
  EXPECT_FALSE(call.next_deadline_ns());
}

} // namespace first_call_test
} // namespace godwit::vehicle_link
