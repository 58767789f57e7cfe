#include "io/link/refusal_watch.hpp"

#include <gtest/gtest.h>

namespace godwit::io::link {
namespace refusal_watch_test {

using namespace std::chrono_literals;

refusal_watch::time_point moment(std::chrono::milliseconds since_start) {
  return refusal_watch::time_point{} + 1h + since_start;
}

TEST(link_refusal_watch, silence_alone_is_no_answer) {
  refusal_watch watch;
  watch.refused();
  EXPECT_FALSE(watch.is_over(moment(1h)));
}

TEST(link_refusal_watch, a_send_that_is_not_refused_for_the_answer_time_ends_the_refusal) {
  refusal_watch watch;
  watch.refused();
  watch.sent(moment(1s));
  watch.sent(moment(3s));
  EXPECT_FALSE(watch.is_over(moment(3'499ms)));
  EXPECT_TRUE(watch.is_over(moment(3'500ms)));
}

TEST(link_refusal_watch, a_new_refusal_starts_the_wait_anew) {
  refusal_watch watch;
  watch.sent(moment(0s));
  watch.refused();
  EXPECT_FALSE(watch.is_over(moment(10s)));
  watch.sent(moment(10s));
  EXPECT_FALSE(watch.is_over(moment(11s)));
}

} // namespace refusal_watch_test
} // namespace godwit::io::link
